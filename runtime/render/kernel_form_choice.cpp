// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/kernel_form_choice.h"

namespace pointrt {

KernelForm kernelFormFor(Integrator integrator, FormRequest request) {
    return castsShadowRays(integrator) ? request.value_or(KernelForm::kMegakernel) : KernelForm::kWavefront;
}

} // namespace pointrt
