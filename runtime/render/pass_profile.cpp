// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/pass_profile.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

#include "runtime/util/clock.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

constexpr std::uint64_t kWord = sizeof(std::uint32_t), kVector = sizeof(gpu::vec4), kHit = sizeof(gpu::uvec4);
constexpr std::uint64_t kPath = sizeof(gpu::PathState), kQuery = sizeof(gpu::DirectLightQuery);
/// Bytes of a queued path whose throughput is not needed.
constexpr std::uint64_t kQueuedRay = kPath - kVector;
/// The surface is stored once, and loaded once by the pass that shades it; the hit is loaded and stored.
constexpr std::uint64_t kSurfaceOfHit = 2 * sizeof(gpu::StoredSurface) + 2 * kHit;
constexpr std::uint64_t kShadowRay = sizeof(gpu::ShadowRay);
/// Two of the waiting Gaussians, stored or loaded.
constexpr std::uint64_t kWaiting = 2 * sizeof(gpu::WaitingGaussian);
/// Film traffic of accumulating light: rgb of one layer and the luminance, read and written.
constexpr std::uint64_t kAddedLight = 2 * (3 * kWord + kWord);

/// Memory traffic of a program in bytes (see PassTally::bytes): per lane, per ray that it queues, and per query or
/// shadow ray that it appends to LIST_DIRECT_LIGHT. direct: additional bytes per lane with STEP_DIRECT.
struct PassBytes {
    const char* program;
    std::uint64_t bytes, ray = kPath, query = kQuery, direct = 0;
};

constexpr PassBytes kPassBytes[] = {
    {"prepare", 2 * sizeof(gpu::Control)},
    {"intersect_shapes (camera)", kHit},
    {"intersect_shapes", kWord + kQueuedRay + kHit},
    {"beam", kWord},
    {"intersect_camera", kHit}, // plus the number and beam of a tile, 1/64 of a word each
    {"intersect_closest", kWord + kQueuedRay + kHit},
    {"surface (camera)", kWord + kSurfaceOfHit},
    {"surface", kWord + kQueuedRay + kSurfaceOfHit},
    {"composite_gaussians (camera)", kHit + kVector},
    {"composite_gaussians", kWord + kPath + kHit + kVector},
    {"gaussian_first_hits", 2 * FIRST_HIT_VECTORS* kVector},
    {"gather_gaussians (camera)", kHit + kWaiting},
    {"gather_gaussians", kWord + kPath + kHit + kWaiting},
    // rays that continue are appended to LIST_DIRECT_LIGHT without a query
    {"blend_gaussians (camera)", kHit + kWaiting + kVector, kPath, 0},
    {"blend_gaussians", kWord + kHit + kWaiting + kVector, kPath, 0},
    {"blend_first_hits", kWaiting + FIRST_HIT_VECTORS* kVector, kPath, 0},
    {"query_shadow_catcher (camera)", kVector + kQuery},
    {"query_shadow_catcher", kWord + kPath + kVector + kQuery},
    {"shade_shadow_catcher", kWord + kQuery + 2 * kVector},
    {"attenuate_shadow", kWord + kQuery + kWord},
    {"attenuate_shadow_ray", kWord + 2 * kShadowRay},
    {"first_hits", kHit + FIRST_HIT_VECTORS* kVector},
    {"fold_film", 4 * FILM_LAYERS* kVector}, // both halves of the film, loaded and stored
    {"shade_surface (camera)", kHit + 2 * FILM_LAYERS* kVector},
    {"shade_surface", kWord + kPath + kHit + kAddedLight},
    {"intersect_shadow_shapes", kWord + kQuery + kWord},
    {"intersect_shadow", kWord + kQuery + 2 * kWord},
    {"shade_shadow", kWord + kQuery + kWord + kAddedLight},
    // with one light sample; megakernels that sample every light append queries, which are larger than shadow rays
    {"megakernel (camera)", kHit + 2 * FILM_LAYERS* kVector, kPath + kHit, kShadowRay},
    {"megakernel", kWord + kPath + kHit + 2 * kVector, kPath + kHit, kShadowRay, 2 * kVector},
    {"intersect_shadow_ray", kWord + kShadowRay + kAddedLight},
    {"cull_closest", kWord + 2 * kVector + kHit + kWord},
    {"cull_shadow", kWord + kQuery + 2 * kWord},
    {"cull_shadow_ray", kWord + 2 * kVector + kWord},
    {"compact", 2 * kWord},
    {"accumulate_shadow", kWord + kShadowRay + kAddedLight},
    {"caustic", kWord + kQuery + kAddedLight},
};

/// Largest number of passes timed in one submission: enough for a sample of a long path or with many lamps. A
/// submission with more is divided.
constexpr std::uint32_t kTimedPasses = 256;

/// Entries that a run has appended to queues and lists, and the bytes stored with them.
struct Appended {
    std::uint64_t entries = 0, bytes = 0;
};

Appended appendedBy(const PassRun& run, const PassBytes& each_has) {
    Appended sum;
    if (run.lanes == PassLanes::kOne) return sum; // prepare resets the counters
    const auto add = [&](std::uint32_t before, std::uint32_t after, std::uint64_t bytes) {
        sum.entries += after - before;
        sum.bytes += (after - before) * (kWord + bytes);
    };
    for (const int queue : {0, 1}) add(run.before.queued[queue], run.after.queued[queue], each_has.ray);
    const auto in_list = [&](std::uint32_t list) {
        const gpu::RayList &before = run.before.lists[list], &after = run.after.lists[list];
        if (list < LIST_CULLED)
            return add(before.appended, after.appended, list == LIST_DIRECT_LIGHT ? each_has.query : 0);
        add(before.compacted, after.compacted, 0);
    };
    for (std::uint32_t list = 0; list < LISTS; ++list) in_list(list);
    add(run.before.hit_count, run.after.hit_count, kHit);
    add(run.before.tile_count, run.after.tile_count, 0);
    return sum;
}

const PassBytes& bytesOf(std::string_view program) {
    for (const PassBytes& each : kPassBytes)
        if (program == each.program) return each;
    throw std::logic_error("kPassBytes lacks the program " + std::string(program));
}

/// The tally of that name, appended if new.
template <typename Tally>
Tally& tallyOf(std::vector<Tally>& tallies, const std::string& name) {
    const auto at = std::find_if(tallies.begin(), tallies.end(), [&](const Tally& each) { return each.name == name; });
    if (at != tallies.end()) return *at;
    tallies.push_back({});
    tallies.back().name = name;
    return tallies.back();
}

} // namespace

PassClock createPassClock(Device& device) {
    PassClock clock;
    if (device.type == VK_PHYSICAL_DEVICE_TYPE_CPU) {
        clock.timer = createGpuTimer(device);
        return clock;
    }
    clock.timer = createGpuTimer(device, kTimedPasses);
    const OnError undo([&] { destroyPassClock(device, clock); });
    if (clock.timer.pool)
        clock.counters = createBuffer(device, "profile counters", (kTimedPasses + 1) * sizeof(gpu::Control), 0,
                                      MemoryHome::kReadback);
    return clock;
}

void destroyPassClock(Device& device, PassClock& clock) {
    destroyGpuTimer(device, clock.timer);
    destroyBuffer(device, clock.counters);
}

void clearProfile(PassProfile& profile) {
    const PassClock clock = profile.clock;
    profile = {};
    profile.clock = clock;
}

double unaccountedMilliseconds(const PassProfile& profile) {
    double rest = profile.frames_ms;
    for (const PassTally& each : profile.passes) rest -= each.host_ms;
    for (const HostTally& each : profile.host) rest -= each.ms;
    return rest;
}

std::uint64_t lanesIn(const gpu::Control& control, PassLanes lanes, std::uint32_t tiles, std::uint32_t list) {
    switch (lanes) {
    case PassLanes::kOne:
        return 1;
    case PassLanes::kTiles:
        return tiles;
    case PassLanes::kTilesLeft:
        return std::uint64_t{control.tile_count} * TILE_PIXELS;
    case PassLanes::kPixels:
        return control.primary_rays;
    case PassLanes::kQueueZero:
        return control.queued[0];
    case PassLanes::kQueueOne:
        return control.queued[1];
    case PassLanes::kList:
        return control.lists[list].count;
    case PassLanes::kHits:
        return control.hit_count;
    }
    return 0;
}

void addRun(PassProfile& profile, const PassRun& run) {
    PassTally& tally = tallyOf(profile.passes, run.name);
    const PassBytes& bytes = bytesOf(run.name);
    const Appended appended = appendedBy(run, bytes);
    const std::uint64_t lanes = lanesIn(run.before, run.lanes, run.tiles, run.list);
    ++tally.runs;
    tally.host_ms += run.host_ms;
    tally.cpu_ms += run.cpu_ms;
    tally.device_ms += run.device_ms.value_or(0);
    tally.lanes_in += lanes;
    tally.lanes_out += appended.entries;
    tally.bytes += lanes * (bytes.bytes + (run.step & STEP_DIRECT ? bytes.direct : 0)) + appended.bytes;
}

HostSpan::HostSpan(PassProfile* profile, const char* name) : profile_(profile), name_(name) {
    if (profile_) start_ = Clock::now();
}

HostSpan::~HostSpan() {
    if (!profile_) return;
    tallyOf(profile_->host, name_).ms += millisecondsSince(start_);
}

} // namespace pointrt
