// SPDX-License-Identifier: Apache-2.0
#include "tests/support/embree_discs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>

#include "format/base/error.h"
#include "tests/support/embree.h"

namespace pointrt::test {

namespace {

constexpr std::size_t kPacket = 8;
/// Rays per task, a multiple of kPacket, large enough that scheduling costs nothing.
constexpr std::size_t kBlockRays = 1024;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

EmbreeHit hitOf(unsigned primitive, float t) {
    return primitive == RTC_INVALID_GEOMETRY_ID ? EmbreeHit{} : EmbreeHit{t, primitive};
}

EmbreeHit castOne(RTCScene scene, const Ray& ray) {
    embree::IntersectOptions options(embree::Coherence::kNone);
    RTCRayHit query{};
    query.ray.org_x = static_cast<float>(ray.origin.x);
    query.ray.org_y = static_cast<float>(ray.origin.y);
    query.ray.org_z = static_cast<float>(ray.origin.z);
    query.ray.dir_x = static_cast<float>(ray.direction.x);
    query.ray.dir_y = static_cast<float>(ray.direction.y);
    query.ray.dir_z = static_cast<float>(ray.direction.z);
    query.ray.tfar = kInfinity;
    query.ray.mask = ~0u;
    query.hit.geomID = query.hit.primID = RTC_INVALID_GEOMETRY_ID;
    embree::intersect1(scene, options, query);
    return hitOf(query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? RTC_INVALID_GEOMETRY_ID : query.hit.primID,
                 query.ray.tfar);
}

/// rays and hits must have the same length, at most kPacket.
void castEight(RTCScene scene, std::span<const Ray> rays, EmbreeHit* hits) {
    embree::IntersectOptions options(embree::Coherence::kNone);
    alignas(32) int valid[kPacket] = {};
    RTCRayHit8 query{};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        valid[i] = -1;
        query.ray.org_x[i] = static_cast<float>(rays[i].origin.x);
        query.ray.org_y[i] = static_cast<float>(rays[i].origin.y);
        query.ray.org_z[i] = static_cast<float>(rays[i].origin.z);
        query.ray.dir_x[i] = static_cast<float>(rays[i].direction.x);
        query.ray.dir_y[i] = static_cast<float>(rays[i].direction.y);
        query.ray.dir_z[i] = static_cast<float>(rays[i].direction.z);
        query.ray.tfar[i] = kInfinity;
        query.ray.mask[i] = ~0u;
        query.hit.geomID[i] = query.hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    embree::intersect8(valid, scene, options, query);
    for (std::size_t i = 0; i < rays.size(); ++i)
        hits[i] = hitOf(query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? RTC_INVALID_GEOMETRY_ID : query.hit.primID[i],
                        query.ray.tfar[i]);
}

/// body(first, count) over blocks of rays, on all cores.
template <typename Body>
void forBlocks(std::size_t rays, Body&& body) {
    const std::size_t blocks = (rays + kBlockRays - 1) / kBlockRays;
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        const std::size_t first = block * kBlockRays;
        body(first, std::min(kBlockRays, rays - first));
    });
}

} // namespace

struct EmbreeDiscs::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::atomic<std::int64_t> bytes = 0;
    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
    void requireNoError() const {
        const RTCError error = rtcGetDeviceError(device);
        if (error != RTC_ERROR_NONE) throw Error(ExitCode::kCannotRun, "Embree error " + std::to_string(error));
    }
    void addDiscs(std::span<const CubeSplat> splats) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
        auto* centers = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), splats.size()));
        auto* normals = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), splats.size()));
        requireNoError();
        for (const CubeSplat& splat : splats) {
            for (const double value : {splat.center.x, splat.center.y, splat.center.z, splat.radius})
                *centers++ = static_cast<float>(value);
            for (const double value : {splat.normal.x, splat.normal.y, splat.normal.z})
                *normals++ = static_cast<float>(value);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }
};

EmbreeDiscs::EmbreeDiscs(std::span<const CubeSplat> splats, EmbreeFlag flag) : state_(new State) {
    state_->device = rtcNewDevice(nullptr);
    state_->requireNoError();
    rtcSetDeviceMemoryMonitorFunction(
        state_->device,
        [](void* state, ssize_t change, bool) {
            static_cast<State*>(state)->bytes += change;
            return true;
        },
        state_.get());
    state_->scene = rtcNewScene(state_->device);
    rtcSetSceneFlags(state_->scene, flag == EmbreeFlag::kRobust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    state_->addDiscs(splats);
    rtcCommitScene(state_->scene);
    state_->requireNoError();
}

EmbreeDiscs::~EmbreeDiscs() = default;

RTCSceneTy* EmbreeDiscs::scene() const { return state_->scene; }
std::int64_t EmbreeDiscs::bytes() const { return state_->bytes; }

std::vector<EmbreeHit> EmbreeDiscs::cast(std::span<const Ray> rays) const {
    std::vector<EmbreeHit> hits(rays.size());
    forBlocks(rays.size(), [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) hits[i] = castOne(state_->scene, rays[i]);
    });
    return hits;
}

std::vector<EmbreeHit> EmbreeDiscs::castPackets(std::span<const Ray> rays) const {
    std::vector<EmbreeHit> hits(rays.size());
    forBlocks(rays.size(), [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; i += kPacket)
            castEight(state_->scene, rays.subspan(i, std::min(kPacket, first + count - i)), &hits[i]);
    });
    return hits;
}

} // namespace pointrt::test
