// SPDX-License-Identifier: Apache-2.0
// Rays sifted for instances: where there are many, a list of rays is held against the boxes that these can be hit in,
// and each is asked for those alone that come into its own (shaders/trace/sift.glsl).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// Some of a scene's instances, one behind the other, and their boxes.
struct InstanceSieve {
    std::size_t first = 0, count = 0; ///< at most SIEVE_TARGETS
    gpu::Sieve boxes{};
};

/// Whether rays may ever be sifted for the scene's instances, which for sets are now these, now those.
bool maySift(const DeviceScene& scene);

/// Sieves for all instances of a scene as they are now; none where there are so few that it takes longer than asking
/// each for all rays.
std::vector<InstanceSieve> makeSieves(const DeviceScene& scene);

/// How many boxes a sieve's programs are built for, by how many it has.
std::uint32_t sieveSize(std::size_t count);
/// All of these that the scene's instances take, or may take when others come.
std::vector<std::uint32_t> sieveSizes(const DeviceScene& scene);

} // namespace pointrt
