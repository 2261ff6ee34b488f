// SPDX-License-Identifier: Apache-2.0
// Which form passes have is known before anything is traced: it hangs on the kind of device and scene alone.
#include "runtime/render/kernel_form_choice.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

constexpr VkPhysicalDeviceType kProcessor = VK_PHYSICAL_DEVICE_TYPE_CPU;

constexpr Integrator kShowLight[] = {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath};

TEST(KernelForm, IsFusedOnProcessors) {
    for (const Integrator integrator : kShowLight) {
        EXPECT_EQ(kernelFormFor(kProcessor, integrator, {}), KernelForm::kMegakernel);
        for (const VkPhysicalDeviceType device :
             {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
              VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_OTHER})
            EXPECT_EQ(kernelFormFor(device, integrator, {}), KernelForm::kWavefront);
    }
}

TEST(KernelForm, IsQueuedWhereNoLightIsShown) {
    for (const FormRequest asked : {FormRequest(), FormRequest(KernelForm::kMegakernel)})
        for (const Integrator integrator : {Integrator::kNormal, Integrator::kDepth})
            EXPECT_EQ(kernelFormFor(kProcessor, integrator, asked), KernelForm::kWavefront);
}

TEST(KernelForm, IsTheOneAskedForOnAnyDevice) {
    for (const VkPhysicalDeviceType device : {kProcessor, VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU})
        for (const Integrator integrator : kShowLight)
            for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel})
                EXPECT_EQ(kernelFormFor(device, integrator, form), form);
}

} // namespace
} // namespace pointrt
