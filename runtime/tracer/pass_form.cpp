// SPDX-License-Identifier: Apache-2.0
#include "runtime/tracer/pass_form.h"

#include "runtime/scene/integrator.h"

namespace pointrt {

FormNeeds formNeeds(const DeviceScene& scene, const RenderSettings& settings) {
    return {hasTrait(settings.integrator, INTEGRATOR_BY_CHANCE), castsCaustics(scene)};
}

PassForm passFormFor(VkPhysicalDeviceType device, FormNeeds needs, FormRequest request) {
    if (!needs.by_chance || needs.caustics) return PassForm::kQueued;
    return request.value_or(device == VK_PHYSICAL_DEVICE_TYPE_CPU ? PassForm::kFused : PassForm::kQueued);
}

} // namespace pointrt
