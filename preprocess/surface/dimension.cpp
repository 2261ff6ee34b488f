// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/dimension.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tbb/parallel_for.h>

#include "preprocess/surface/plane_fit.h"

namespace pointrt::surface {
namespace {

/// Root mean square height of the neighbours over the tangent plane, in reaches, up to which no more is asked: a point
/// of a sphere whose radius is three reaches has 0.1, one in a solid ball 0.45. Of a million samples of a scanned
/// statue's mesh 1 in 70 is above.
constexpr float kFlatHeight = 0.15f;

/// Smallest eigenvalue over the middle one, at the better of two scales. Below kSheet lie nine of ten points of raw
/// range scans whose error is a third of their spacing, above kScatter nine of ten in a solid ball.
constexpr float kSheet = 0.12f, kScatter = 0.25f;

/// Neighbours that lie on one of at most three faces, of all: a corner has them all there; in tree crowns three planes
/// take half of them.
constexpr float kFaces = 0.8f, kNoFaces = 0.6f;
constexpr int kMostFaces = 3;
/// A neighbour is on a face when it is no higher than this over it, in reaches, and faces no other way.
constexpr float kFaceHeight = 0.1f, kFaceCosine = 0.8f;

/// Mean share over a point's neighbours and theirs: where most are of a surface, the few that are not are its edges and
/// corners; where most are scattered, the few that lie in a plane do by chance.
constexpr float kAmongSheets = 0.5f, kAmongScatter = 0.25f;

/// A cloud with fewer scattered points than this share is one of surfaces: their thinnest parts look scattered to lists
/// that reach around them. Of a million samples of scanned meshes 3 in a thousand do.
constexpr double kMinScattered = 0.01;

/// 1 at `sure` and beyond, 0 at `none` and beyond, a straight line between.
float ramp(float value, float none, float sure) { return std::clamp((value - none) / (sure - none), 0.0f, 1.0f); }

/// Share of the neighbours that lie on few faces: the point's own tangent plane, then that of the nearest neighbour on
/// none so far.
float faceShare(const Points& points, const NeighborLists& lists, std::size_t point) {
    const auto neighbors = lists.of(point);
    const float highest = kFaceHeight * lists.reach(points, point);
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

/// Marks what is not flat at first sight: [points], 0 flat, 1 the neighbour of one that is not, 2 not flat.
std::vector<std::uint8_t> markUneven(const Points& points, const NeighborLists& lists, const StageShare& share) {
    std::vector<std::uint8_t> marks(points.size(), 0);
    const auto raise = [&](std::size_t point, std::uint8_t mark) {
        std::atomic_ref<std::uint8_t> at(marks[point]);
        std::uint8_t seen = at.load(std::memory_order_relaxed);
        while (seen < mark && !at.compare_exchange_weak(seen, mark, std::memory_order_relaxed)) {
        }
    };
    forEach(points.size(), share, [&](std::size_t i) {
        if (heightOver(points, lists, i) <= kFlatHeight * lists.reach(points, i)) return;
        raise(i, 2);
        for (const std::uint32_t neighbor : lists.of(i)) raise(neighbor, 1);
    });
    return marks;
}

/// By the neighbourhood of a point that is not flat at first sight.
float ownShare(const Points& points, const NeighborLists& lists, const std::vector<Moments>& moments,
               std::size_t point) {
    const float misfit = fitPlane(moments[point]).misfit;
    if (misfit <= kSheet) return 1;
    const float faces = ramp(faceShare(points, lists, point), kNoFaces, kFaces);
    if (faces == 1) return 1;
    const float wider = fitPlane(spreadMoments(moments, points, lists, point)).misfit;
    return std::max(faces, ramp(std::min(misfit, wider), kScatter, kSheet));
}

std::vector<float> ownShares(const Points& points, const NeighborLists& lists, const StageShare& share) {
    std::vector<float> own(points.size(), 1);
    const std::vector<std::uint8_t> marks = markUneven(points, lists, share);
    if (std::count(marks.begin(), marks.end(), 2) == 0) return own;
    std::vector<Moments> moments(points.size());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        if (marks[i] > 0) moments[i] = momentsOf(points, lists.of(i), i);
    });
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        if (marks[i] == 2) own[i] = ownShare(points, lists, moments, i);
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

std::size_t countScattered(const std::vector<float>& shares, const std::vector<std::uint8_t>& inner) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) count += inner[i] && shares[i] < 0.5f;
    return count;
}

} // namespace

bool isScattered(std::size_t scattered, std::size_t points) {
    return scattered > std::size_t(kMinScattered * double(points));
}

std::vector<float> sheetShares(const Points& points, const NeighborLists& lists, std::optional<bool> decided,
                               const std::vector<std::uint8_t>& inner, std::size_t& scattered,
                               const StageShare& share) {
    scattered = 0;
    if (decided ? !*decided : points.size() < kFewForSheets) return {};
    std::vector<float> shares = ownShares(points, lists, share);
    const std::size_t own = countScattered(shares, inner);
    if (!decided && own == 0) return {};
    shares = averaged(lists, averaged(lists, shares));
    for (float& value : shares) value = ramp(value, kAmongScatter, kAmongSheets);
    scattered = std::min(own, countScattered(shares, inner));
    const auto counted = std::size_t(std::count(inner.begin(), inner.end(), 1));
    return decided || isScattered(scattered, counted) ? shares : std::vector<float>();
}

} // namespace pointrt::surface
