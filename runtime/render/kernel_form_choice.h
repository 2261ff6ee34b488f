// SPDX-License-Identifier: Apache-2.0
// Choice between megakernel and wavefront kernels. Both trace the same rays; their pictures differ by rounding only.
#pragma once

#include "runtime/gpu/vulkan.h"
#include "runtime/render/kernel_form.h"
#include "runtime/scene/integrator.h"

namespace pointrt {

/// The requested form, or else the megakernel on CPUs, where every vector that goes through memory costs time, and
/// wavefront kernels on GPUs, which have threads enough to hide that and fewer registers. Integrators that use no
/// lights have wavefront kernels only.
KernelForm kernelFormFor(VkPhysicalDeviceType device, Integrator integrator, FormRequest request);

} // namespace pointrt
