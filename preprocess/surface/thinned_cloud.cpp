// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/thinned_cloud.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "preprocess/cloud/morton.h"

namespace pointrt::surface {
namespace {

/// A level with fewer representatives is the last: a point needs some in all directions.
constexpr std::size_t kFewestRepresentatives = 32;

/// Representatives in a ring, for findIsolated.
constexpr std::size_t kInRing = 12;
constexpr float kAlone = 4.5f;
/// Levels of fewer cells show the shape of the whole cloud.
constexpr std::size_t kFewestCells = 64;

/// The edge of the cells that all grids are aligned to. Positions span less than 1, so that they start in one of two
/// such cells, and codes of kMortonBits bits reach down to kFinestExponent.
constexpr int kCoarsestExponent = 1;
constexpr int kFinestExponent = kCoarsestExponent + 1 - kMortonBits;

/// A point with the code of its cell.
struct CodedPoint {
    std::uint64_t code = 0;
    std::uint32_t point = 0;

    bool operator<(const CodedPoint& other) const {
        return code != other.code ? code < other.code : point < other.point;
    }
};

/// All points in the order of the cells.
std::vector<CodedPoint> codedPoints(const PointSet& points, int exponent) {
    Vec3f low = points.positions.front();
    for (const Vec3f& position : points.positions) low = low.cwiseMin(position);
    const double coarsest = std::ldexp(1.0, kCoarsestExponent), inverse = std::ldexp(1.0, -exponent);
    const Vec3d base = (low.cast<double>() / coarsest).array().floor().matrix() * coarsest;
    std::vector<CodedPoint> coded(points.size());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        const Vec3d place = (points.positions[i].cast<double>() - base) * inverse;
        coded[i] = {mortonCode(std::uint64_t(place.x()), std::uint64_t(place.y()), std::uint64_t(place.z())),
                    std::uint32_t(i)};
    });
    if (!std::is_sorted(coded.begin(), coded.end())) tbb::parallel_sort(coded.begin(), coded.end());
    return coded;
}

/// The begins of runs of equal codes, and the end of the last one.
std::vector<std::uint32_t> cellsIn(const std::vector<CodedPoint>& coded) {
    std::vector<std::uint32_t> first;
    for (std::size_t i = 0; i < coded.size(); ++i)
        if (i == 0 || coded[i].code != coded[i - 1].code) first.push_back(std::uint32_t(i));
    first.push_back(std::uint32_t(coded.size()));
    return first;
}

/// The point nearest to the mean of all points of a cell, so that it does not depend on the finer levels there are.
std::uint32_t representative(std::span<const CodedPoint> cell, const std::vector<Vec3f>& positions) {
    if (cell.size() == 1) return cell.front().point;
    Vec3d sum = Vec3d::Zero();
    for (const CodedPoint& place : cell) sum += positions[place.point].cast<double>();
    const Vec3f mean = (sum / double(cell.size())).cast<float>();
    std::uint32_t best = cell.front().point;
    for (const CodedPoint& place : cell) {
        const float squared = squaredDistance(positions[place.point], mean),
                    least = squaredDistance(positions[best], mean);
        if (squared < least || (squared == least && place.point < best)) best = place.point;
    }
    return best;
}

ThinnedLevel levelOf(const std::vector<CodedPoint>& coded, const std::vector<Vec3f>& positions, int exponent) {
    std::vector<std::uint32_t> first = cellsIn(coded), points(first.size() - 1);
    std::vector<Vec3f> middles(points.size());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t i) {
        points[i] = representative({&coded[first[i]], first[i + 1] - first[i]}, positions);
        middles[i] = positions[points[i]];
    });
    NearestSearch search(middles); // its memory moves along
    return {std::ldexp(1.0f, exponent), std::move(points), std::move(first), std::move(middles), std::move(search)};
}

} // namespace

ThinnedCloud::ThinnedCloud(const PointSet& points, float finest) {
    int exponent = std::clamp(std::ilogb(finest), kFinestExponent, kCoarsestExponent);
    std::vector<CodedPoint> coded = codedPoints(points, exponent);
    for (const CodedPoint& place : coded) order_.push_back(place.point);
    for (; exponent <= kCoarsestExponent; ++exponent) {
        levels_.push_back(levelOf(coded, points.positions, exponent));
        if (levels_.back().points.size() < kFewestRepresentatives) return;
        for (CodedPoint& place : coded) place.code >>= 3;
    }
}

std::size_t ThinnedCloud::levelFor(float edge) const {
    std::size_t number = 0;
    while (number < levels_.size() && levels_[number].edge < edge) ++number;
    return number;
}

std::vector<std::uint32_t> ThinnedCloud::findIsolated() const {
    std::vector<std::uint32_t> isolated(order_.size(), 0);
    for (std::size_t number = 0; number < levels_.size(); ++number) {
        const ThinnedLevel& level = levels_[number];
        if (level.points.size() < kFewestCells) break;
        const float beyond =
            std::nextafter(kAlone * kAlone * level.edge * level.edge, std::numeric_limits<float>::max());
        tbb::parallel_for(std::size_t(0), level.points.size(), [&](std::size_t cell) {
            std::array<std::uint32_t, kInRing - 1> found; // a search ends when it finds more
            if (level.search.within(level.positions[cell], beyond, found) == kInRing) return;
            for (std::uint32_t i = level.first[cell]; i < level.first[cell + 1]; ++i)
                isolated[order_[i]] |= std::uint32_t(1) << number;
        });
    }
    return isolated;
}

} // namespace pointrt::surface
