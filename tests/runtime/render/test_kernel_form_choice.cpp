// SPDX-License-Identifier: Apache-2.0
// The kernel form depends only on the kind of device, the integrator and the request.
#include "runtime/render/kernel_form_choice.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

constexpr VkPhysicalDeviceType kProcessor = VK_PHYSICAL_DEVICE_TYPE_CPU;

constexpr Integrator kShowLight[] = {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath};

TEST(KernelForm, IsMegakernelOnCpus) {
    for (const Integrator integrator : kShowLight) {
        EXPECT_EQ(kernelFormFor(kProcessor, integrator, {}), KernelForm::kMegakernel);
        for (const VkPhysicalDeviceType device :
             {VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
              VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_OTHER})
            EXPECT_EQ(kernelFormFor(device, integrator, {}), KernelForm::kWavefront);
    }
}

TEST(KernelForm, IsWavefrontWithoutLight) {
    for (const FormRequest request : {FormRequest(), FormRequest(KernelForm::kMegakernel)})
        for (const Integrator integrator : {Integrator::kNormal, Integrator::kDepth})
            EXPECT_EQ(kernelFormFor(kProcessor, integrator, request), KernelForm::kWavefront);
}

TEST(KernelForm, CanBeRequestedOnAnyDevice) {
    for (const VkPhysicalDeviceType device : {kProcessor, VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU})
        for (const Integrator integrator : kShowLight)
            for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel})
                EXPECT_EQ(kernelFormFor(device, integrator, form), form);
}

} // namespace
} // namespace pointrt
