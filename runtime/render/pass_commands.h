// SPDX-License-Identifier: Apache-2.0
// Records and submits passes: all in one submission, or when profiling one submission per pass.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

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
    /// Of samples whose counters, gpu::Control, are in control. profile may be null; it and the buffers must outlive
    /// this.
    /// @param read room for the counters of samples, host-readable
    PassCommands(Device& device, const Buffer& control, const Buffer& read, PassProfile* profile);

    /// Starts a sample or its next passes. tiles: of the band.
    void beginSample(std::uint32_t tiles) { tiles_ = tiles; }
    /// Sets the parameters of later passes.
    void setParams(const Buffer& buffer, const gpu::FrameParams& params);
    /// Its writes are visible to later passes.
    void run(const Pass& pass);
    /// Copies how many rays have hit the instances just traced to counts[place] of each: the length of the hit list, or
    /// where several tiles were traced together what intersect_closest has counted. Not while profiling.
    void copyHitCounts(const Buffer& counts, const std::vector<std::size_t>& places);
    /// Keeps the counters as they are after the passes so far. At most `samples` times.
    void endSample();
    /// Records commands that are not passes, after all passes so far.
    void record(const std::function<void(VkCommandBuffer)>& commands);
    /// Waits for all passes and returns the counters that endSample kept.
    std::vector<gpu::Control> finish();

private:
    void record(const Pass& pass);
    void runTimed(const Pass& pass);
    gpu::Control readControl();

    Device& device_;
    const Buffer &control_, &read_;
    std::uint32_t tiles_ = 0;
    PassProfile* profile_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE; ///< when not profiling
    std::uint32_t samples_ = 0;                 ///< ended
    gpu::Control counters_{};                   ///< when profiling: after the last pass
    std::vector<gpu::Control> ended_;           ///< when profiling
};

} // namespace pointrt
