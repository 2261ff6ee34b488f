// SPDX-License-Identifier: Apache-2.0
// Choice between megakernel and wavefront kernels. Both trace the same rays; their pictures differ by rounding only.
#pragma once

#include "runtime/render/kernel_form.h"
#include "runtime/scene/integrator.h"

namespace pointrt {

/// The requested form, or else the megakernel, which moves less through memory: on CPUs a loop over a path's bounces,
/// on GPUs one bounce per dispatch (SPEC_ONE_BOUNCE), with half the registers and a third more traffic. Integrators
/// that use no lights have wavefront kernels only.
KernelForm kernelFormFor(Integrator integrator, FormRequest request);

} // namespace pointrt
