// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/pass_form.h"

namespace pointrt {

PassForm passFormFor(VkPhysicalDeviceType device, Integrator integrator, FormRequest request) {
    if (!showsLight(integrator)) return PassForm::kQueued;
    return request.value_or(device == VK_PHYSICAL_DEVICE_TYPE_CPU ? PassForm::kFused : PassForm::kQueued);
}

} // namespace pointrt
