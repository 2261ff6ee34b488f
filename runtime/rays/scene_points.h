// SPDX-License-Identifier: Apache-2.0
// The points of a scene with all of their attributes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/rays/point_source.h"

namespace pointrt {

/// Reads points instance by instance, in world coordinates. Points of a .pro come in the order of its input, without
/// those that fill gaps; points of a tile set come from the cores of its original tiles, one of which is open at a
/// time. The columns are those that all instances have; scenes of several instances add instance_id. Throws Error
/// kBadInput if a path is not a scene.
/// @param replaced columns that the results replace
std::unique_ptr<PointSource> scenePoints(const std::vector<std::string>& paths,
                                         const std::vector<std::string>& replaced);

/// All splats of a scene of one .pro, in the order of its file, with those that fill gaps. Otherwise as scenePoints.
std::unique_ptr<PointSource> sceneSplats(const std::vector<std::string>& paths,
                                         const std::vector<std::string>& replaced);

/// The columns that all instances have, the bounds, and the coordinate system of the first instance unless the scene
/// moves it. Throws as scenePoints does.
PointOutline sceneOutline(const std::vector<std::string>& paths);

} // namespace pointrt
