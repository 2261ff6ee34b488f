// SPDX-License-Identifier: Apache-2.0
// Warnings about options that have no effect on the loaded scene.
#pragma once

#include <string>
#include <vector>

#include "runtime/session/options.h"

namespace pointrt {

/// Properties of a scene that decide whether options have an effect.
struct SceneTraits {
    bool has_tiles = false;          ///< it has tile sets
    bool has_secondary_rays = false; ///< with its integrator, a surface reflects, refracts or scatters
    bool has_walked = false;         ///< some of its scans have no boxes for ray queries, so shaders traverse them
    bool uses_lights = true;         ///< its integrator renders light, not normals or depths
};

/// A line for each given option without effect, without the tool's name.
std::vector<std::string> optionsWithoutEffect(const Options& options, const SceneTraits& scene);

} // namespace pointrt
