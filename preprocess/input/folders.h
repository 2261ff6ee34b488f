// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces folders of scans by their files.
#pragma once

#include <string>
#include <vector>

namespace pointrt {

/// Replaces each folder by its files with a suffix that this build reads (with or without ".gz"), sorted by name. .txt,
/// .csv, .bin and .tif files count only if there is nothing else, and subfolders only if there is no file; hidden ones
/// are ignored. If there are .conf files, only these are used: they name the others. A folder with the description of a
/// SOG (meta.json, lod-meta.json), of EPT (ept.json) or of a Potree octree (metadata.json), or with the points of
/// COLMAP (points3D.bin or .txt), is replaced by that file alone. Throws Error (kBadInput) for a folder without any
/// scan.
std::vector<std::string> filesOf(const std::vector<std::string>& paths);

} // namespace pointrt
