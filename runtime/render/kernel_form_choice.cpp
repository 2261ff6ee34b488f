// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/kernel_form_choice.h"

namespace pointrt {

KernelForm kernelFormFor(VkPhysicalDeviceType device, Integrator integrator, FormRequest request) {
    if (!usesLights(integrator)) return KernelForm::kWavefront;
    return request.value_or(device == VK_PHYSICAL_DEVICE_TYPE_CPU ? KernelForm::kMegakernel : KernelForm::kWavefront);
}

} // namespace pointrt
