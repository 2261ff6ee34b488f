// SPDX-License-Identifier: Apache-2.0
// Points of LAS, LAZ and PLY files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "format/pointio/point_reader.h"
#include "runtime/rays/point_source.h"

namespace pointrt {

/// Reads all columns but the replaced ones. Normals and radii in the file are used for the points' discs.
/// @param file for messages
/// @param scene supplies the coordinate system, unit and position step that the file lacks
std::unique_ptr<PointSource> filePoints(const std::string& file, std::unique_ptr<PointReader> reader,
                                        const PointOutline& scene, const std::vector<std::string>& replaced);

} // namespace pointrt
