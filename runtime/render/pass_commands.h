// SPDX-License-Identifier: Apache-2.0
// Passes on their way to the device: in one submission, or for a profile each in one of its own.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>

#include "runtime/gpu/program.h"
#include "runtime/render/pass_profile.h"

namespace pointrt {

/// A pass: a program over the lanes of a list, or over so many workgroups.
struct Pass {
    const Program& program;
    const DescriptorSets& sets;
    std::span<const std::byte> push;
    PassLanes lanes = PassLanes::kOne;
    std::uint32_t groups = 0; ///< 0: as control says for the list
    std::uint32_t list = 0;   ///< of kList: LIST_* or after
};

class PassCommands {
public:
    /// Bands of so many tiles. profile may be null; it and control must outlive this.
    PassCommands(Device& device, const Buffer& control, std::uint32_t tiles, PassProfile* profile);

    /// What later ones read it has written by then.
    void run(const Pass& pass);
    /// Copies how many hits the list of hits has to a place in counts, unless a profile is taken.
    void copyHitCount(const Buffer& counts, std::size_t place);
    /// Returns when all passes are done, with the counters as they are then.
    gpu::Control finish();

private:
    void record(const Pass& pass);
    void runTimed(const Pass& pass);
    gpu::Control readControl();

    Device& device_;
    const Buffer& control_;
    std::uint32_t tiles_;
    PassProfile* profile_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE; ///< without a profile
    gpu::Control counters_{};                   ///< with one: after the last pass
};

} // namespace pointrt
