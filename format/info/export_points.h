// SPDX-License-Identifier: Apache-2.0
// Splats as a point cloud that other tools read.
#pragma once

#include <string>

#include "format/info/export_source.h"

namespace pointrt {

/// Writes every splat of source, in its order, with normal, radius, colour and all attributes, as openPointSink says:
/// PLY, LAS or LAZ by the end of path; "-" is PLY to standard output. Throws as that does, also when path exists and
/// not overwrite.
void exportPoints(const ExportSource& source, const std::string& path, bool overwrite);

} // namespace pointrt
