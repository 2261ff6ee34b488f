// SPDX-License-Identifier: Apache-2.0
// Splats as a point cloud that other tools read.
#pragma once

#include <string>

#include "format/info/export_source.h"

namespace pointrt {

/// Writes every splat of source, in its order, as binary little-endian PLY:
/// double x y z and float radius in input units, float nx ny nz, uchar red green blue where the file has colours, and a
/// property for each component of each attribute (NAME, or NAME_0 ... of several; 64-bit integers as double).
/// "-" is standard output; else path appears complete or not at all. Throws Error (kCannotWrite), also when path exists
/// and not overwrite.
void exportPly(const ExportSource& source, const std::string& path, bool overwrite);

} // namespace pointrt
