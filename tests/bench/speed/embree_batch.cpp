// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/speed/embree_batch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <type_traits>

#include "tests/support/embree.h"

namespace pointrt::test {

namespace {

constexpr std::size_t kPacket = 8;
/// Rays per task: so many that the overhead of scheduling is negligible.
constexpr std::size_t kBlockRays = 1024;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Valid {
    alignas(32) int lanes[kPacket]; // as rtcIntersect8 wants it
};

// One interface for the four kinds of query: the number of rays, the members of a ray, and the call.
template <typename Query>
constexpr std::size_t kLanes = 1;
template <>
constexpr std::size_t kLanes<RTCRay8> = kPacket;
template <>
constexpr std::size_t kLanes<RTCRayHit8> = kPacket;

float& lane(float& member, std::size_t) { return member; }
unsigned& lane(unsigned& member, std::size_t) { return member; }
float& lane(float (&member)[kPacket], std::size_t i) { return member[i]; }
unsigned& lane(unsigned (&member)[kPacket], std::size_t i) { return member[i]; }

RTCRay& rayOf(RTCRay& query) { return query; }
RTCRay8& rayOf(RTCRay8& query) { return query; }
RTCRay& rayOf(RTCRayHit& query) { return query.ray; }
RTCRay8& rayOf(RTCRayHit8& query) { return query.ray; }

void call(RTCScene scene, embree::OccludedOptions& options, const Valid&, RTCRay& query) {
    embree::occluded1(scene, options, query);
}
void call(RTCScene scene, embree::IntersectOptions& options, const Valid&, RTCRayHit& query) {
    embree::intersect1(scene, options, query);
}
void call(RTCScene scene, embree::OccludedOptions& options, const Valid& valid, RTCRay8& query) {
    embree::occluded8(valid.lanes, scene, options, query);
}
void call(RTCScene scene, embree::IntersectOptions& options, const Valid& valid, RTCRayHit8& query) {
    embree::intersect8(valid.lanes, scene, options, query);
}

template <typename Query>
constexpr bool kHasHit = requires(Query query) {
    query.hit;
};

template <typename Query>
using OptionsOf = std::conditional_t<kHasHit<Query>, embree::IntersectOptions, embree::OccludedOptions>;

template <typename Query>
void setRay(Query& query, std::size_t i, const Ray& from) {
    auto& ray = rayOf(query);
    lane(ray.org_x, i) = static_cast<float>(from.origin.x);
    lane(ray.org_y, i) = static_cast<float>(from.origin.y);
    lane(ray.org_z, i) = static_cast<float>(from.origin.z);
    lane(ray.dir_x, i) = static_cast<float>(from.direction.x);
    lane(ray.dir_y, i) = static_cast<float>(from.direction.y);
    lane(ray.dir_z, i) = static_cast<float>(from.direction.z);
    lane(ray.tfar, i) = kInfinity;
    lane(ray.mask, i) = ~0u;
    if constexpr (kHasHit<Query>) {
        lane(query.hit.geomID, i) = RTC_INVALID_GEOMETRY_ID;
        lane(query.hit.primID, i) = RTC_INVALID_GEOMETRY_ID;
    }
}

template <typename Query>
EmbreeHit hitOf(Query& query, std::size_t i) {
    const float t = lane(rayOf(query).tfar, i);
    if constexpr (kHasHit<Query>) {
        const unsigned splat = lane(query.hit.primID, i);
        return splat == RTC_INVALID_GEOMETRY_ID ? EmbreeHit{} : EmbreeHit{t, splat};
    } else {
        return t < 0 ? EmbreeHit{0, 0} : EmbreeHit{}; // minus infinity marks an occluded ray
    }
}

template <typename Query>
std::vector<Query> fill(std::span<const Ray> rays) {
    std::vector<Query> queries((rays.size() + kLanes<Query> - 1) / kLanes<Query>);
    for (std::size_t i = 0; i < rays.size(); ++i) setRay(queries[i / kLanes<Query>], i % kLanes<Query>, rays[i]);
    return queries;
}

/// Seconds.
template <typename Query>
double trace(RTCScene scene, std::vector<Query>& queries, std::size_t rays, bool coherent) {
    const auto start = std::chrono::steady_clock::now();
    const tbb::blocked_range<std::size_t> all(0, queries.size(), kBlockRays / kLanes<Query>);
    tbb::parallel_for(
        all,
        [&](const tbb::blocked_range<std::size_t>& block) {
            OptionsOf<Query> options(coherent ? embree::Coherence::kCoherent : embree::Coherence::kNone);
            Valid valid;
            std::fill_n(valid.lanes, kPacket, -1);
            for (std::size_t q = block.begin(); q < block.end(); ++q) {
                if (q + 1 == queries.size()) // the lanes beyond the last ray
                    std::fill(valid.lanes + rays - q * kLanes<Query>, valid.lanes + kLanes<Query>, 0);
                call(scene, options, valid, queries[q]);
            }
        },
        tbb::simple_partitioner());
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <typename Query>
EmbreeRun run(const EmbreeDiscs& discs, std::span<const Ray> rays, bool coherent) {
    std::vector<Query> queries = fill<Query>(rays);
    EmbreeRun result{trace(discs.scene(), queries, rays.size(), coherent), {}};
    for (std::size_t i = 0; i < rays.size(); ++i)
        result.hits.push_back(hitOf(queries[i / kLanes<Query>], i % kLanes<Query>));
    return result;
}

} // namespace

EmbreeRun runEmbree(const EmbreeDiscs& discs, std::span<const Ray> rays, EmbreeMode mode, bool any_hit, bool coherent) {
    if (mode == EmbreeMode::kSingle)
        return any_hit ? run<RTCRay>(discs, rays, coherent) : run<RTCRayHit>(discs, rays, coherent);
    return any_hit ? run<RTCRay8>(discs, rays, coherent) : run<RTCRayHit8>(discs, rays, coherent);
}

} // namespace pointrt::test
