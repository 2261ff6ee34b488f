// SPDX-License-Identifier: Apache-2.0
#include "tests/support/embree_discs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <string>
#include <utility>

#include "format/base/error.h"
#include "tests/support/embree.h"

namespace pointrt::test {

namespace {

constexpr std::size_t kPacket = 8;
/// Rays per task, a multiple of kPacket, large enough that scheduling costs nothing.
constexpr std::size_t kBlockRays = 1024;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// The splats of each of the scene's geometries, by primitive.
using SplatsOfGeometry = std::vector<std::vector<std::uint32_t>>;

EmbreeHit hitOf(const SplatsOfGeometry& splats, unsigned geometry, unsigned primitive, float t) {
    return geometry == RTC_INVALID_GEOMETRY_ID ? EmbreeHit{} : EmbreeHit{t, splats[geometry][primitive]};
}

EmbreeHit castOne(RTCScene scene, const SplatsOfGeometry& splats, const Ray& ray) {
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
    return hitOf(splats, query.hit.geomID, query.hit.primID, query.ray.tfar);
}

/// rays and hits must have the same length, at most kPacket.
void castEight(RTCScene scene, const SplatsOfGeometry& splats, std::span<const Ray> rays, EmbreeHit* hits) {
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
        hits[i] = hitOf(splats, query.hit.geomID[i], query.hit.primID[i], query.ray.tfar[i]);
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
    SplatsOfGeometry splats;
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
    /// Adds the balls or the discs among the splats as one Embree geometry.
    void add(std::span<const CubeSplat> all, bool balls) {
        std::vector<std::uint32_t> added;
        for (std::uint32_t i = 0; i < all.size(); ++i)
            if ((all[i].normal == Vec3{}) == balls) added.push_back(i);
        if (added.empty()) return;
        RTCGeometry geometry =
            rtcNewGeometry(device, balls ? RTC_GEOMETRY_TYPE_SPHERE_POINT : RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
        auto* centers = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), added.size()));
        auto* normals =
            balls ? nullptr
                  : static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3,
                                                                3 * sizeof(float), added.size()));
        requireNoError();
        for (const std::uint32_t i : added) {
            for (const double value : {all[i].center.x, all[i].center.y, all[i].center.z, all[i].radius})
                *centers++ = static_cast<float>(value);
            if (balls) continue;
            for (const double value : {all[i].normal.x, all[i].normal.y, all[i].normal.z})
                *normals++ = static_cast<float>(value);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(splats.size()));
        rtcReleaseGeometry(geometry);
        splats.push_back(std::move(added));
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
    state_->add(splats, false);
    state_->add(splats, true);
    rtcCommitScene(state_->scene);
    state_->requireNoError();
}

EmbreeDiscs::~EmbreeDiscs() = default;

RTCSceneTy* EmbreeDiscs::scene() const { return state_->scene; }
std::int64_t EmbreeDiscs::bytes() const { return state_->bytes; }

std::vector<EmbreeHit> EmbreeDiscs::cast(std::span<const Ray> rays) const {
    std::vector<EmbreeHit> hits(rays.size());
    forBlocks(rays.size(), [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) hits[i] = castOne(state_->scene, state_->splats, rays[i]);
    });
    return hits;
}

std::vector<EmbreeHit> EmbreeDiscs::castPackets(std::span<const Ray> rays) const {
    std::vector<EmbreeHit> hits(rays.size());
    forBlocks(rays.size(), [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; i += kPacket)
            castEight(state_->scene, state_->splats, rays.subspan(i, std::min(kPacket, first + count - i)), &hits[i]);
    });
    return hits;
}

} // namespace pointrt::test
