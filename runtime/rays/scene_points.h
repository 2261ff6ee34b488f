// SPDX-License-Identifier: Apache-2.0
// The points of scenes with all of their attributes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/rays/point_source.h"

namespace pointrt {

/// Instance by instance, in the world's coordinates: of a .pro its points in the order of its input, without those that
/// fill gaps; of a tile set those of its original tiles' cores, tile by tile, one of which is open at a time. Columns
/// are those that all instances have, and of several instance_id. Throws Error kBadInput for what is no scene.
std::unique_ptr<PointSource> scenePoints(const std::vector<std::string>& paths,
                                         const std::vector<std::string>& left_out);

/// What is said of all of them: columns that all instances have, bounds, the first one's coordinate system where it is
/// not moved. Throws the same.
PointOutline sceneOutline(const std::vector<std::string>& paths);

} // namespace pointrt
