// SPDX-License-Identifier: Apache-2.0
// Which form passes have is known before anything is traced: it hangs on the kind of device and scene alone.
#include "runtime/render/pass_form.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

constexpr VkPhysicalDeviceType kProcessor = VK_PHYSICAL_DEVICE_TYPE_CPU;

constexpr Integrator kShowLight[] = {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath};

TEST(PassForm, IsFusedOnProcessors) {
    for (const Integrator integrator : kShowLight) {
        EXPECT_EQ(passFormFor(kProcessor, integrator, {}), PassForm::kFused);
        for (const VkPhysicalDeviceType device :
             {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
              VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_OTHER})
            EXPECT_EQ(passFormFor(device, integrator, {}), PassForm::kQueued);
    }
}

TEST(PassForm, IsQueuedWhereNoLightIsShown) {
    for (const FormRequest asked : {FormRequest(), FormRequest(PassForm::kFused)})
        for (const Integrator integrator : {Integrator::kNormal, Integrator::kDepth})
            EXPECT_EQ(passFormFor(kProcessor, integrator, asked), PassForm::kQueued);
}

TEST(PassForm, IsTheOneAskedForOnAnyDevice) {
    for (const VkPhysicalDeviceType device : {kProcessor, VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU})
        for (const Integrator integrator : kShowLight)
            for (const PassForm form : {PassForm::kQueued, PassForm::kFused})
                EXPECT_EQ(passFormFor(device, integrator, form), form);
}

} // namespace
} // namespace pointrt
