// SPDX-License-Identifier: GPL-3.0-or-later
// Names of files that make a folder a COLMAP model.
#pragma once

#include <string_view>

namespace pointrt {

inline constexpr std::string_view kColmapBinary = "points3D.bin", kColmapText = "points3D.txt";

/// Whether a file has points of COLMAP: by its first line, or the first of its records.
bool isColmap(std::string_view bytes);

} // namespace pointrt
