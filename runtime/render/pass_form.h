// SPDX-License-Identifier: Apache-2.0
// The two forms of a frame's passes. They trace the same rays, and their pictures differ by rounding alone.
#pragma once

#include "runtime/gpu/vulkan.h"
#include "runtime/render/form_of_passes.h"
#include "runtime/scene/integrator.h"

namespace pointrt {

/// The fused form where it can be and pays, unless another one is asked for: for integrators that show light; on
/// processors, which pay for every vector that goes through memory. GPUs have threads enough to hide that, and fewer
/// registers.
PassForm passFormFor(VkPhysicalDeviceType device, Integrator integrator, FormRequest request);

} // namespace pointrt
