// SPDX-License-Identifier: Apache-2.0
// What a run writes against what it reads.
#pragma once

#include "runtime/scene/scene_description.h"
#include "runtime/session/options.h"

namespace pointrt {

/// Throws Error kBadUsage where the picture, the report or the recording would be written over the scene, one of its
/// files or one another, and where a picture would be written to a terminal.
void requireOutputsApart(const Options& options, const SceneDescription& scene);

} // namespace pointrt
