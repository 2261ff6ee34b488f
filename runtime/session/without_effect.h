// SPDX-License-Identifier: Apache-2.0
// Options that change nothing of a scene as it is, which nobody can know before it is loaded.
#pragma once

#include <string>
#include <vector>

#include "runtime/session/options.h"

namespace pointrt {

/// What decides whether an option has something to change.
struct SceneTraits {
    bool has_tiles = false;  ///< it has sets of tiles
    bool sends_on = false;   ///< a surface reflects, refracts or scatters, as the integrator goes
    bool shows_light = true; ///< the integrator is one of light, not of normals or depths
};

/// A line for each option that was given and has nothing to change, without the tool's name.
std::vector<std::string> optionsWithoutEffect(const Options& options, const SceneTraits& scene);

} // namespace pointrt
