// SPDX-License-Identifier: Apache-2.0
// Protects the inputs of a run from being overwritten.
#pragma once

#include "runtime/scene/scene_description.h"
#include "runtime/session/options.h"

namespace pointrt {

/// Throws Error kBadUsage if the picture, the report or the recording would overwrite the scene, a file that the scene
/// uses, or one another, or if the picture would be written to a terminal.
void requireOutputsApart(const Options& options, const SceneDescription& scene);

} // namespace pointrt
