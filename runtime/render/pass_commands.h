// SPDX-License-Identifier: Apache-2.0
// Records and submits passes: all in one submission, except that profiling on a CPU device takes one submission per
// pass.
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
    bool overlaps = false;    ///< the next pass uses no buffer that this one writes, and writes none that it uses
};

/// Where a submission stores the counters of its samples and its time.
struct PassReadback {
    const Buffer& counters; ///< host-readable, with room for kSamplesAtOnce of each submission
    std::uint32_t place = 0;
    const GpuTimer* timer = nullptr; ///< times the submission as its range `place`; optional
};

/// The counters of `samples` samples of a submission that is done.
std::vector<gpu::Control> readCounters(const Device& device, const PassReadback& readback, std::uint32_t samples);

class PassCommands {
public:
    /// For samples whose counters (gpu::Control) are in control. profile may be null; profile, timer and the buffers
    /// must outlive this.
    PassCommands(Device& device, const Buffer& control, const PassReadback& readback, PassProfile* profile);

    /// Labels the passes recorded during its lifetime, for debuggers; not while profiling.
    CommandLabel label(const char* name) const { return {device_, profile_ ? VK_NULL_HANDLE : commands_, name}; }
    /// Starts a sample or its next passes. tiles: number of the band's tiles.
    void beginSample(std::uint32_t tiles) { tiles_ = tiles; }
    /// Sets the parameters of later passes.
    void setParams(const Buffer& buffer, const gpu::FrameParams& params);
    /// Later passes see what this one writes.
    void run(const Pass& pass);
    /// Copies the number of rays that hit each of the instances just traced to its counts[place]: the length of the hit
    /// list, or, if several tiles were traced together, the counts of intersect_closest. Does nothing if each pass is
    /// submitted by itself.
    void copyHitCounts(const Buffer& counts, const std::vector<std::size_t>& places);
    /// Stores the counters as they are after the passes so far. At most `samples` times.
    void endSample();
    /// Records commands that are not passes, after all passes so far.
    void record(const std::function<void(VkCommandBuffer)>& commands);
    /// Waits for all passes and returns the counters that endSample stored.
    std::vector<gpu::Control> finish();
    /// Submits all passes in place of finish, and returns the submission's number; its counters are read with
    /// readCounters. Not while profiling.
    std::uint64_t submit();
    /// The same, but with the next submission (submitWithNext).
    std::uint64_t submitLater();
    std::uint32_t samples() const { return samples_; } ///< samples that ended

private:
    VkCommandBuffer end();
    bool submitsEach() const { return profile_ && !profile_->clock.counters.handle; }
    void record(const Pass& pass);
    void runAlone(const Pass& pass);
    void recordTimed(const Pass& pass);
    void copyCounters(std::size_t place);
    void readTimed();
    gpu::Control readControl();

    Device& device_;
    const Buffer& control_;
    PassReadback readback_;
    std::uint32_t tiles_ = 0;
    PassProfile* profile_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE; ///< null if each pass is submitted by itself
    std::uint32_t samples_ = 0;                 ///< samples that ended
    std::vector<PassRun> timed_;                ///< recorded passes, when profiling
    gpu::Control counters_{};                   ///< counters after the last pass that was submitted by itself
    std::vector<gpu::Control> ended_;           ///< of samples whose passes were submitted by themselves
};

} // namespace pointrt
