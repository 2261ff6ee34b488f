// SPDX-License-Identifier: Apache-2.0
// Profile of frames: time and memory traffic of each kind of pass, and host time between passes.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/gpu_timer.h"
#include "runtime/gpu/resources.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// All runs of a program.
struct PassTally {
    std::string name; ///< of the program
    std::uint64_t runs = 0;
    double device_ms = 0; ///< by the device's clock, if it has one
    double host_ms = 0;   ///< by the host's clock: recording, and waiting for passes that have their own submission
    double cpu_ms = 0;    ///< CPU time of this process meanwhile, including a CPU device's threads; 0 if not measured
    std::uint64_t lanes_in = 0;  ///< lanes with work
    std::uint64_t lanes_out = 0; ///< entries they appended to queues and lists
    /// Bytes of queues, paths, hits, surfaces, light and film loaded and stored, counted from the shader sources.
    /// Excludes reads of the scan by traversal and blending, which depend on each ray.
    std::uint64_t bytes = 0;
};

/// Host time outside passes.
struct HostTally {
    std::string name;
    double ms = 0;
};

/// Measures passes. On a CPU device, or without timestamps, each pass is submitted separately and its processor time is
/// measured too; otherwise the passes of a submission are timed within it.
struct PassClock {
    GpuTimer timer;
    /// gpu::Control before each pass of a submission and after the last; without a handle if each pass is submitted
    /// separately.
    Buffer counters;
};

/// Owned by the caller: free it with destroyPassClock before the device.
PassClock createPassClock(Device& device);
void destroyPassClock(Device& device, PassClock& clock);

struct PassProfile {
    PassClock clock; ///< owned by the session
    std::uint64_t frames = 0;
    double frames_ms = 0;          ///< total time of the frames, by the host's clock
    std::vector<PassTally> passes; ///< ordered by first run
    std::vector<HostTally> host;   ///< ordered by first use
};

/// Resets everything but the clock.
void clearProfile(PassProfile& profile);

/// Time of the frames that neither passes nor host spans account for, in milliseconds.
double unaccountedMilliseconds(const PassProfile& profile);

/// What a lane of a pass works on; gpu::Control has the number of lanes.
enum class PassLanes { kOne, kTiles, kTilesLeft, kPixels, kQueueZero, kQueueOne, kList, kHits };

/// Number of lanes with work. tiles: of the band; list: for kList, LIST_* or a culled list.
std::uint64_t lanesIn(const gpu::Control& control, PassLanes lanes, std::uint32_t tiles, std::uint32_t list = 0);

/// One run of a pass, with the counters before and after it.
struct PassRun {
    const char* name = "";
    PassLanes lanes = PassLanes::kOne;
    std::uint32_t tiles = 0;
    gpu::Control before, after;
    double host_ms = 0, cpu_ms = 0;
    std::optional<double> device_ms;
    std::uint32_t list = 0; ///< for kList
    std::uint32_t step = 0; ///< STEP_*
};
/// Throws std::logic_error for a program that is not in kPassBytes (pass_profile.cpp).
void addRun(PassProfile& profile, const PassRun& run);

/// Times the host during its lifetime, under a name. Spans must not nest, nor contain a pass.
class HostSpan {
public:
    HostSpan(PassProfile* profile, const char* name);
    ~HostSpan();
    HostSpan(const HostSpan&) = delete;
    HostSpan& operator=(const HostSpan&) = delete;

private:
    PassProfile* profile_; ///< null: nothing is recorded
    const char* name_;
    std::chrono::steady_clock::time_point start_{};
};

} // namespace pointrt
