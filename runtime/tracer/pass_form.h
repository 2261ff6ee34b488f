// SPDX-License-Identifier: Apache-2.0
// The two forms of a frame's passes. They trace the same rays, and their pictures differ by rounding alone.
#pragma once

#include <optional>

#include "runtime/device_scene/device_scene.h"
#include "runtime/film/form_of_passes.h"

namespace pointrt {

/// What decides of the form besides the device.
struct FormNeeds {
    bool by_chance = false; ///< the integrator asks one light and follows one ray at a hit
    bool caustics = false;  ///< photons are gathered where light is asked for
};
FormNeeds formNeeds(const DeviceScene& scene, const RenderSettings& settings);

/// The fused form where it can be and pays, unless another one is asked for: on processors, which pay for every vector
/// that goes through memory. GPUs have threads enough to hide that, and fewer registers.
PassForm passFormFor(VkPhysicalDeviceType device, FormNeeds needs, FormRequest request);

} // namespace pointrt
