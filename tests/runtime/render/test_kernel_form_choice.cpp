// SPDX-License-Identifier: Apache-2.0
// The kernel form depends only on the integrator and the request.
#include "runtime/render/kernel_form_choice.h"

#include <gtest/gtest.h>

namespace pointrt {
namespace {

constexpr Integrator kShowLight[] = {Integrator::kPhong, Integrator::kWhitted, Integrator::kPath};

TEST(KernelForm, IsMegakernelUnlessRequested) {
    for (const Integrator integrator : kShowLight) {
        EXPECT_EQ(kernelFormFor(integrator, {}), KernelForm::kMegakernel);
        for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel})
            EXPECT_EQ(kernelFormFor(integrator, form), form);
    }
}

TEST(KernelForm, IsWavefrontWithoutLight) {
    for (const FormRequest request : {FormRequest(), FormRequest(KernelForm::kMegakernel)})
        for (const Integrator integrator : {Integrator::kNormal, Integrator::kDepth})
            EXPECT_EQ(kernelFormFor(integrator, request), KernelForm::kWavefront);
}

} // namespace
} // namespace pointrt
