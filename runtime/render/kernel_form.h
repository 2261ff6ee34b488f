// SPDX-License-Identifier: Apache-2.0
// The two forms of the integrator's kernels. A saved film must be continued in the form in which it was started.
#pragma once

#include <optional>

namespace pointrt {

enum class KernelForm {
    kWavefront,  ///< one program per step; path states go through queues in memory between them
    kMegakernel, ///< one program shades a hit and follows the path, with its state in registers, to where it needs
                 ///< instances; GPUs stop after one bounce
};

/// The form to use on every device; none: the one that suits the device.
using FormRequest = std::optional<KernelForm>;

} // namespace pointrt
