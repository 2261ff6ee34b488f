// SPDX-License-Identifier: Apache-2.0
// Points of LAS, LAZ and PLY files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "format/pointio/point_reader.h"
#include "runtime/rays/point_source.h"

namespace pointrt {

/// All columns that the file has but those left out; normals and radii, where it has some, are those of the points'
/// discs.
/// @param file for messages
/// @param scene what is said of the scene's points: of coordinates that the file says nothing of
std::unique_ptr<PointSource> filePoints(const std::string& file, std::unique_ptr<PointReader> reader,
                                        const PointOutline& scene, const std::vector<std::string>& left_out);

} // namespace pointrt
