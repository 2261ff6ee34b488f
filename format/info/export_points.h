// SPDX-License-Identifier: Apache-2.0
// Exports splats as a point cloud.
#pragma once

#include <string>

#include "format/info/export_source.h"

namespace pointrt {

/// Writes every splat of source, in its order, with normal, radius, colour and all attributes: PLY, PCD, LAS, LAZ or
/// E57 by the suffix of path; "-" is PLY on standard output. Throws as openPointSink does, also if path exists and
/// overwrite is false.
/// @param scalar_names names of attributes in PLY files start with "scalar_", as CloudCompare's do
void exportPoints(const ExportSource& source, const std::string& path, bool overwrite, bool scalar_names = false);

} // namespace pointrt
