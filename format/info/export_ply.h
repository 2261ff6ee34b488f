// SPDX-License-Identifier: Apache-2.0
// Splats as a point cloud that other tools read.
#pragma once

#include <string>

#include "pointrt/pro.hpp"

namespace pointrt {

/// Writes every splat once, in input order (in file order where the file has none), as binary little-endian PLY:
/// double x y z and float radius in input units, float nx ny nz, and uchar red green blue where the file has colours.
/// "-" is standard output; else path appears complete or not at all. Throws Error (kCannotWrite), also when path exists
/// and not overwrite.
void exportPly(const ProFile& file, const std::string& path, bool overwrite);

} // namespace pointrt
