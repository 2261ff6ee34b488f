// SPDX-License-Identifier: Apache-2.0
// What programs that look into an instance are built for.
#pragma once

#include <compare>
#include <vector>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/paged_buffer.h"
#include "runtime/gpu/program.h"

namespace pointrt {

/// What programs know of an instance: whether it is uneven, oriented, noisy and a tile (shaders/trace/instance.glsl),
/// and where it has several, its pages (shaders/lib/pages.glsl).
struct InstanceTraits {
    bool uneven = false, oriented = false, noisy = false, cored = false;
    PageCounts pages; ///< all 0 where each buffer has one
    auto operator<=>(const InstanceTraits&) const = default;
};

/// is_tile: its hits count in a core alone.
InstanceTraits traitsOf(const DeviceScan& file, bool oriented, bool is_tile);
InstanceTraits traitsOf(const DeviceScene& scene, const Instance& instance);

/// What programs are specialized by for them; those of pages only where there are several.
std::vector<SpecConstant> traitConstants(const InstanceTraits& traits);

} // namespace pointrt
