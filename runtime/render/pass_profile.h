// SPDX-License-Identifier: Apache-2.0
// Where the time of frames goes: what every kind of pass took and moved, and what the host did between them.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/gpu/device_clock.h"
#include "shaders/shared/params.h"

namespace pointrt {

/// All runs of a program.
struct PassTally {
    std::string name; ///< of the program
    std::uint64_t runs = 0;
    double device_ms = 0;        ///< by its clock, where it has one
    double host_ms = 0;          ///< recorded, submitted and waited for, by the host's
    double cpu_ms = 0;           ///< of this process's threads meanwhile, a device's that is a processor among them
    std::uint64_t lanes_in = 0;  ///< that had something to do
    std::uint64_t lanes_out = 0; ///< entries they put into queues and lists
    /// Of queues, paths, hits, surfaces, light and film, loaded and stored, by what the sources say. What walks and
    /// blending read of a scan is not among it: that hangs on the way of each ray.
    std::uint64_t bytes = 0;
};

/// What the host did that is no pass.
struct HostTally {
    std::string name;
    double ms = 0;
};

struct PassProfile {
    DeviceClock clock; ///< the session's, which makes it and frees it
    std::uint64_t frames = 0;
    double frames_ms = 0;          ///< of whole frames, by the host's clock
    std::vector<PassTally> passes; ///< in the order of their first runs
    std::vector<HostTally> host;   ///< likewise
};

/// As if nothing had run yet.
void clearProfile(PassProfile& profile);

/// What of the frames neither passes nor host account for, in milliseconds.
double unaccountedMilliseconds(const PassProfile& profile);

/// The list a pass works on: its length is what control says.
enum class PassLanes { kOne, kTiles, kTilesLeft, kPixels, kQueueZero, kQueueOne, kList, kHits };

/// Lanes with something to do; tiles: of the band; list: of kList, LIST_* or after.
std::uint64_t lanesIn(const gpu::Control& control, PassLanes lanes, std::uint32_t tiles, std::uint32_t list = 0);

/// A run of a pass, with the counters before and after it.
struct PassRun {
    const char* name = "";
    PassLanes lanes = PassLanes::kOne;
    std::uint32_t tiles = 0;
    gpu::Control before, after;
    double host_ms = 0, cpu_ms = 0;
    std::optional<double> device_ms;
    std::uint32_t list = 0; ///< of kList
};
/// Throws std::logic_error for a program whose bytes are not told in pass_profile.cpp.
void addRun(PassProfile& profile, const PassRun& run);

/// Times what the host does while it lives, under a name. None of these may live within another, or around a pass.
class HostSpan {
public:
    HostSpan(PassProfile* profile, const char* name);
    ~HostSpan();
    HostSpan(const HostSpan&) = delete;
    HostSpan& operator=(const HostSpan&) = delete;

private:
    PassProfile* profile_; ///< null: nothing is noted
    const char* name_;
    std::chrono::steady_clock::time_point start_{};
};

} // namespace pointrt
