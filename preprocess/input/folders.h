// SPDX-License-Identifier: GPL-3.0-or-later
// Folders of scans as the files in them.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

/// Replaces each folder by the files in it whose names have a suffix that this build reads (".gz" behind it or not), in
/// the order of their names, .txt and .csv only where there is nothing else; hidden files and folders below are left
/// out. Where there are .conf files only those are taken: they name the others. Throws Error (kBadInput) for a folder
/// without any.
std::vector<std::string> filesOf(const std::vector<std::string>& paths);

} // namespace pointrt
