// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/planarity.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tbb/parallel_for.h>

#include "preprocess/surface/plane_fit.h"

namespace pointrt::surface {
namespace {

/// A point is flat if the root mean square height of its neighbours over the tangent plane, in neighbourhood radii, is
/// at most this. It is 0.1 on a sphere of three neighbourhood radii, 0.45 in a solid ball. 1 in 70 of a million
/// samples of a scanned statue's mesh is above.
constexpr float kFlatHeight = 0.15f;

/// Smallest eigenvalue over the middle one, at the better of two scales. Nine in ten points of raw range scans with an
/// error of a third of their spacing are below kPlanar, nine in ten points of a solid ball above kVolumetric.
constexpr float kPlanar = 0.12f, kVolumetric = 0.25f;

/// Share of neighbours on at most three faces: all of them at a corner, half of them in tree crowns.
constexpr float kFaces = 0.8f, kNoFaces = 0.6f;
constexpr int kMostFaces = 3;
/// A neighbour is on a face if its height over it, in neighbourhood radii, is at most this and its normal agrees.
constexpr float kFaceHeight = 0.1f, kFaceCosine = 0.8f;

/// Mean weight over a point's neighbours and theirs: if most are on a surface, the others are its edges and corners; if
/// most are scattered, the few in a plane are there by chance.
constexpr float kAmongSurfaces = 0.5f, kAmongScatter = 0.25f;

/// A cloud with fewer scattered points than this share consists of surfaces: points on their thinnest parts, 3 in a
/// thousand of a million samples of scanned meshes, look scattered, because neighbourhoods reach around these parts.
constexpr double kMinScattered = 0.01;

/// A smoothed point is on a surface if the mean weight over its neighbours and theirs is at least this. On the folds of
/// a statue, with noise two thirds of a spacing wide, 7 in 8 moved points that had looked scattered are above; in
/// single trees 1 in 3 are, and in airborne scans of forests 1 in 5 to 1 in 16.
constexpr float kOnSmoothedSurface = 0.9f;

/// 1 at `sure` and beyond, 0 at `none` and beyond, linear in between.
float ramp(float value, float none, float sure) { return std::clamp((value - none) / (sure - none), 0.0f, 1.0f); }

/// Share of the neighbours on few faces: the point's own tangent plane, then that of the nearest neighbour that is on
/// none so far.
float faceShare(const PointSet& points, const NeighborLists& lists, std::size_t point) {
    const auto neighbors = lists.of(point);
    const float highest = kFaceHeight * lists.radius(points, point);
    std::vector<std::uint8_t> on_face(neighbors.size(), 0);
    std::size_t base = point;
    for (int face = 0; face < kMostFaces; ++face) {
        const Vec3f origin = points.positions[base], normal = points.normals[base];
        for (std::size_t i = 0; i < neighbors.size(); ++i) {
            const float height = normal.dot(points.positions[neighbors[i]] - origin);
            const float cosine = normal.dot(points.normals[neighbors[i]]);
            on_face[i] |= std::abs(height) <= highest && std::abs(cosine) >= kFaceCosine;
        }
        const auto left = std::find(on_face.begin(), on_face.end(), std::uint8_t(0));
        if (left == on_face.end()) break;
        base = neighbors[std::size_t(left - on_face.begin())];
    }
    return float(std::count(on_face.begin(), on_face.end(), 1)) / float(neighbors.size());
}

/// [points], 0: flat by height over the tangent plane; 1: flat, but a neighbour is not; 2: not flat.
std::vector<std::uint8_t> markUneven(const PointSet& points, const NeighborLists& lists, const StageShare& share) {
    std::vector<std::uint8_t> marks(points.size(), 0);
    const auto raise = [&](std::size_t point, std::uint8_t mark) {
        std::atomic_ref<std::uint8_t> at(marks[point]);
        std::uint8_t seen = at.load(std::memory_order_relaxed);
        while (seen < mark && !at.compare_exchange_weak(seen, mark, std::memory_order_relaxed)) {
        }
    };
    forEach(points.size(), share, [&](std::size_t i) {
        if (heightOver(points, lists, i) <= kFlatHeight * lists.radius(points, i)) return;
        raise(i, 2);
        for (const std::uint32_t neighbor : lists.of(i)) raise(neighbor, 1);
    });
    return marks;
}

/// The weight of a point that is not flat, from its neighbourhood.
float ownWeight(const PointSet& points, const NeighborLists& lists, const std::vector<Moments>& moments,
                std::size_t point) {
    const float misfit = misfitOf(moments[point]);
    if (misfit <= kPlanar) return 1;
    const float faces = ramp(faceShare(points, lists, point), kNoFaces, kFaces);
    if (faces == 1) return 1;
    const float wider = misfitOf(spreadMoments(moments, points, lists, point));
    return std::max(faces, ramp(std::min(misfit, wider), kVolumetric, kPlanar));
}

std::vector<float> ownWeights(const PointSet& points, const NeighborLists& lists, const StageShare& share) {
    std::vector<float> own(points.size(), 1);
    const std::vector<std::uint8_t> marks = markUneven(points, lists, share);
    if (std::count(marks.begin(), marks.end(), 2) == 0) return own;
    std::vector<Moments> moments(points.size());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        if (marks[i] > 0) moments[i] = momentsOf(points, lists.of(i), i);
    });
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        if (marks[i] == 2) own[i] = ownWeight(points, lists, moments, i);
    });
    return own;
}

/// The mean over each point and its neighbours.
std::vector<float> averaged(const NeighborLists& lists, const std::vector<float>& values) {
    std::vector<float> means(values.size());
    tbb::parallel_for(std::size_t(0), values.size(), [&](std::size_t i) {
        float sum = values[i];
        for (const std::uint32_t neighbor : lists.of(i)) sum += values[neighbor];
        means[i] = sum / float(lists.k + 1);
    });
    return means;
}

std::vector<float> averagedTwice(const NeighborLists& lists, const std::vector<float>& values) {
    return averaged(lists, averaged(lists, values));
}

std::size_t countScattered(const std::vector<float>& weights, const std::vector<std::uint8_t>& inner) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) count += inner[i] && weights[i] < 0.5f;
    return count;
}

} // namespace

bool isScattered(std::size_t scattered, std::size_t points) {
    return scattered > std::size_t(kMinScattered * double(points));
}

std::size_t weighPlanarity(PointGraph& graph, std::optional<bool> decided, const std::vector<std::uint8_t>& inner,
                           const StageShare& share) {
    std::vector<float>& weights = graph.points.planarity;
    weights.clear();
    if (decided ? !*decided : graph.points.size() < kMinPointsForPlanarity) return 0;
    weights = ownWeights(graph.points, graph.lists, share);
    const std::size_t own = countScattered(weights, inner);
    if (!decided && own == 0) {
        weights.clear();
        return 0;
    }
    weights = averagedTwice(graph.lists, weights);
    for (float& weight : weights) weight = ramp(weight, kAmongScatter, kAmongSurfaces);
    const std::size_t scattered = std::min(own, countScattered(weights, inner));
    const auto counted = std::size_t(std::count(inner.begin(), inner.end(), 1));
    if (!decided && !isScattered(scattered, counted)) weights.clear();
    return scattered;
}

void raisePlanarityOfSmoothed(PointGraph& graph, const StageShare& share) {
    PointSet& points = graph.points;
    if (points.support.empty() || points.planarity.empty()) return;
    const std::vector<float> weights = averagedTwice(graph.lists, ownWeights(points, graph.lists, share));
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (points.support[i] > 0 && weights[i] >= kOnSmoothedSurface) points.planarity[i] = 1;
}

} // namespace pointrt::surface
