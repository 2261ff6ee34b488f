// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces folders of scans by their files.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

/// Replaces each folder by its files with a suffix that this build reads (with or without ".gz"), sorted by name. .txt
/// and .csv files count only if there is nothing else; hidden files and subfolders are ignored. If there are .conf
/// files, only these are used: they name the others. A folder with a SOG's meta.json or lod-meta.json is that SOG.
/// Throws Error (kBadInput) for a folder without any scan.
std::vector<std::string> filesOf(const std::vector<std::string>& paths);

} // namespace pointrt
