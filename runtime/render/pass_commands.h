// SPDX-License-Identifier: Apache-2.0
// Records and submits passes: all in one submission, or when profiling one submission per pass.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>

#include "runtime/gpu/program.h"
#include "runtime/render/pass_profile.h"

namespace pointrt {

/// A program run over the lanes of a list, or over a number of workgroups.
struct Pass {
    const Program& program;
    const DescriptorSets& sets;
    std::span<const std::byte> push;
    PassLanes lanes = PassLanes::kOne;
    std::uint32_t groups = 0; ///< 0: indirect, from control
    std::uint32_t list = 0;   ///< for kList: LIST_* or a culled list
};

class PassCommands {
public:
    /// tiles: of the band. profile may be null; it and control must outlive this.
    PassCommands(Device& device, const Buffer& control, std::uint32_t tiles, PassProfile* profile);

    /// Its writes are visible to later passes.
    void run(const Pass& pass);
    /// Copies the length of the hit list to counts[place]; not while profiling.
    void copyHitCount(const Buffer& counts, std::size_t place);
    /// Waits for all passes and returns the counters after the last one.
    gpu::Control finish();

private:
    void record(const Pass& pass);
    void runTimed(const Pass& pass);
    gpu::Control readControl();

    Device& device_;
    const Buffer& control_;
    std::uint32_t tiles_;
    PassProfile* profile_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE; ///< when not profiling
    gpu::Control counters_{};                   ///< when profiling: after the last pass
};

} // namespace pointrt
