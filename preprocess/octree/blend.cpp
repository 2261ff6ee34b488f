// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/octree/blend.h"

#include <algorithm>
#include <limits>

#include "format/base/blend_weight.h"

// Compiles two versions, so that one binary runs on all processors and is twice as fast with AVX2. Both add in the same
// order and round in the same way (no fused operations), so results are equal. Not with sanitizers, whose runtime is
// not ready when the loader selects the version.
#if defined(__x86_64__) && defined(__ELF__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define POINTRT_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define POINTRT_WIDE
#endif

namespace pointrt {

namespace {

constexpr std::size_t kLanes = 8;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));

/// The same type for any element of an array of floats, which may be unaligned.
using LanesInArray = float __attribute__((vector_size(kLanes * sizeof(float)), aligned(sizeof(float)), may_alias));
// Macros, because the calling convention of functions that return wide vectors depends on the processor.
#define LOAD(array, i) (*reinterpret_cast<const LanesInArray*>(&(array)[i]))
#define STORE(array, i, lanes) (*reinterpret_cast<LanesInArray*>(&(array)[i]) = (lanes))

/// A padding disc, which no ray hits and which is near no point.
constexpr float kFarAway = 1e6f, kTiny = 1e-12f;

struct LaneSums {
    Lanes weight{}, height{}, normal[3]{}, color[3]{};
};

float sumOf(const Lanes& lanes) {
    float sum = 0;
    for (std::size_t j = 0; j < kLanes; ++j) sum += lanes[j];
    return sum;
}

float leastOf(const Lanes& lanes) {
    float least = lanes[0];
    for (std::size_t j = 1; j < kLanes; ++j) least = std::min(least, lanes[j]);
    return least;
}

/// Distance to where the ray enters ball i, or leaves it from inside; +infinity for a miss.
float ballDistance(const DiscList& list, std::size_t i, const Vec3f& origin, const Vec3f& direction, float t_max) {
    const Vec3f to_center = Vec3f(list.center[0][i], list.center[1][i], list.center[2][i]) - origin;
    const float middle = to_center.dot(direction), squared = list.radius_squared[i];
    const float half_squared = squared - (middle * direction - to_center).squaredNorm();
    if (!(half_squared > 0.0f)) return std::numeric_limits<float>::infinity();
    const float half_chord = std::sqrt(half_squared);
    const float t = middle - half_chord < 0.0f ? middle + half_chord : middle - half_chord;
    return t >= 0.0f && t <= t_max ? t : std::numeric_limits<float>::infinity();
}

/// Sets the distances of balls: as discs, castRay misses them, since planes of normal 0 have no distance.
void addBallHits(DiscList& list, const Vec3f& origin, const Vec3f& direction, float t_max, FirstHits& hits) {
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (!list.normalOf(i).isZero(0)) continue;
        const float t = list.distance[i] = ballDistance(list, i, origin, direction, t_max);
        hits.any = std::min(hits.any, t);
        if (list.kept[i] > 0.0f) hits.kept = std::min(hits.kept, t);
    }
}

} // namespace

void DiscList::clear() {
    for (int axis = 0; axis < 3; ++axis) {
        center[axis].clear();
        normal[axis].clear();
        color[axis].clear();
    }
    radius_squared.clear();
    kept.clear();
    has_balls = false;
    count_ = 0;
}

void DiscList::append(const Disc& disc, const Vec3f& rgb, bool keep) {
    for (int axis = 0; axis < 3; ++axis) {
        center[axis].push_back(disc.center[axis]);
        normal[axis].push_back(disc.normal[axis]);
        color[axis].push_back(rgb[axis]);
    }
    radius_squared.push_back(disc.radius * disc.radius);
    kept.push_back(keep ? 1.0f : 0.0f);
}

void DiscList::add(const Disc& disc, const Vec3f& rgb, bool keep) {
    append(disc, rgb, keep);
    has_balls |= disc.isBall();
    ++count_;
}

void DiscList::pad() {
    while (kept.size() % kLanes != 0) append({Vec3f::Constant(kFarAway), Vec3f::UnitZ(), kTiny}, Vec3f::Zero(), true);
    for (std::vector<float>* scratch : {&distance, &weight, &height, &flip}) scratch->resize(kept.size());
}

POINTRT_WIDE FirstHits castRay(DiscList& list, const Vec3f& origin, const Vec3f& direction, float t_max) {
    constexpr float kMissed = std::numeric_limits<float>::infinity();
    const float ox = origin.x(), oy = origin.y(), oz = origin.z();
    const float dx = direction.x(), dy = direction.y(), dz = direction.z();
    Lanes any = Lanes{} + kMissed, kept = any;
    const Lanes missed = any;
    for (std::size_t i = 0; i < list.kept.size(); i += kLanes) {
        const Lanes x = LOAD(list.center[0], i) - ox, y = LOAD(list.center[1], i) - oy,
                    z = LOAD(list.center[2], i) - oz;
        const Lanes nx = LOAD(list.normal[0], i), ny = LOAD(list.normal[1], i), nz = LOAD(list.normal[2], i);
        const Lanes t = (nx * x + ny * y + nz * z) / (nx * dx + ny * dy + nz * dz);
        const Lanes ax = t * dx - x, ay = t * dy - y, az = t * dz - z;
        const auto inside = ax * ax + ay * ay + az * az < LOAD(list.radius_squared, i);
        const Lanes hit = (inside & (t >= 0.0f) & (t <= t_max)) ? t : missed;
        STORE(list.distance, i, hit);
        any = hit < any ? hit : any;
        const Lanes hit_kept = LOAD(list.kept, i) > 0.0f ? hit : missed;
        kept = hit_kept < kept ? hit_kept : kept;
    }
    FirstHits hits{leastOf(any), leastOf(kept)};
    if (list.has_balls) addBallHits(list, origin, direction, t_max, hits);
    return hits;
}

POINTRT_WIDE float weighAt(DiscList& list, const Vec3f& point, const Vec3f& side, float front) {
    constexpr float kSlabSquared = kBlendSlab * kBlendSlab;
    const float px = point.x(), py = point.y(), pz = point.z();
    const float sx = side.x(), sy = side.y(), sz = side.z();
    const Lanes zero{}, one = zero + 1.0f, given = zero + front;
    Lanes dropped{};
    for (std::size_t i = 0; i < list.kept.size(); i += kLanes) {
        const Lanes x = px - LOAD(list.center[0], i), y = py - LOAD(list.center[1], i),
                    z = pz - LOAD(list.center[2], i);
        const Lanes nx = LOAD(list.normal[0], i), ny = LOAD(list.normal[1], i), nz = LOAD(list.normal[2], i);
        const Lanes r2 = LOAD(list.radius_squared, i);
        const Lanes h = nx * x + ny * y + nz * z, h2 = h * h;
        const Lanes cosine = nx * sx + ny * sy + nz * sz;
        const Lanes to_viewer = list.oriented ? given : (cosine < 0.0f ? -one : one);
        const Lanes in_plane = 1.0f - (x * x + y * y + z * z - h2) / r2;
        const Lanes in_slab = 1.0f - h2 / (kSlabSquared * r2);
        const Lanes weight =
            BLEND_COUNTS(to_viewer * cosine, in_plane, in_slab) ? BLEND_WEIGHT(in_plane, in_slab) : zero;
        STORE(list.weight, i, weight);
        STORE(list.height, i, to_viewer * h);
        STORE(list.flip, i, to_viewer);
        dropped += weight * (1.0f - LOAD(list.kept, i));
    }
    return sumOf(dropped);
}

POINTRT_WIDE FieldSums sumField(const DiscList& list, bool only_kept) {
    LaneSums sums;
    const Lanes all = Lanes{} + 1.0f;
    for (std::size_t i = 0; i < list.kept.size(); i += kLanes) {
        const Lanes kept = LOAD(list.kept, i);
        const Lanes w = LOAD(list.weight, i) * (only_kept ? kept : all);
        const Lanes flipped = w * LOAD(list.flip, i);
        sums.weight += w;
        sums.height += w * LOAD(list.height, i);
        for (int axis = 0; axis < 3; ++axis) sums.normal[axis] += flipped * LOAD(list.normal[axis], i);
        if (!list.colored) continue;
        for (int axis = 0; axis < 3; ++axis) sums.color[axis] += w * LOAD(list.color[axis], i);
    }
    FieldSums field;
    field.weight = sumOf(sums.weight);
    field.height = sumOf(sums.height);
    for (int axis = 0; axis < 3; ++axis) {
        field.normal[axis] = sumOf(sums.normal[axis]);
        field.color[axis] = sumOf(sums.color[axis]);
    }
    return field;
}

} // namespace pointrt
