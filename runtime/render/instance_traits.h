// SPDX-License-Identifier: Apache-2.0
// Traits of an instance that programs are specialized for.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/paged_buffer.h"
#include "runtime/gpu/program.h"

namespace pointrt {

/// Whether an instance is uneven, oriented, noisy, a tile clipped to its core or cut by clips, whether it may have
/// balls (shaders/trace/instance.glsl) or holds Gaussians, how its buffers are read and its cells found, and the pages
/// of its buffers (shaders/lib/pages.glsl).
struct InstanceTraits {
    bool uneven = false, oriented = false, noisy = false, clips_to_core = false, clipped = false, has_balls = false;
    bool is_gaussian = false;
    bool reads_storage = false;     ///< DeviceScan::reads_storage
    bool queries_rays = false;      ///< DeviceScan::queries_rays
    std::uint32_t pooled_tiles = 0; ///< largest number of tiles of a PooledGroup; 0: a single instance
    std::uint32_t harmonics = 0;    ///< degree of the Gaussians' harmonics
    PageCounts pages;               ///< all 0 if every buffer has a single page
    auto operator<=>(const InstanceTraits&) const = default;
};

/// is_tile: hits are clipped to the core. clipped: the scene has clips.
InstanceTraits traitsOf(const DeviceScan& file, bool oriented, bool is_tile, bool clipped);
InstanceTraits traitsOf(const DeviceScene& scene, const Instance& instance);

/// Specialization constants for the traits; those of pages only if there are several pages.
std::vector<SpecConstant> traitConstants(const InstanceTraits& traits);

} // namespace pointrt
