// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/line_neighborhoods.h"

#include "preprocess/surface/plane_fit.h"

namespace pointrt::surface {
namespace {

/// Whether points spread ten times further along a line than across it. For eigenvalues a >> b, c of the covariance,
/// the second invariant over the squared trace is (b + c) / a, which avoids an eigenvalue solver.
bool isLine(const Moments& moments) {
    constexpr double kLine = 1.0 / (10 * 10);
    const auto& [xx, xy, xz, yy, yz, zz] = moments.covariance;
    const double trace = double(xx) + yy + zz;
    const double invariant =
        double(xx) * yy + double(xx) * zz + double(yy) * zz - double(xy) * xy - double(xz) * xz - double(yz) * yz;
    return invariant < kLine * trace * trace;
}

/// Neighbours selected from a wider search.
struct Selection {
    std::vector<std::uint32_t> indices;
    float spacing = 0;
};

/// Selects k of the count nearest: the first k / 2 + 1, then others at even steps up to the last.
Selection selectFrom(const NearestSearch& search, const PointSet& points, std::size_t point, std::size_t k,
                     std::size_t count) {
    std::vector<std::uint32_t> indices(count + 1);
    std::vector<float> squared(count + 1);
    search.nearest(points.positions[point], indices, squared);
    Selection selection;
    const std::size_t dense = k / 2 + 1, sparse = k - dense;
    for (std::size_t i = 0; i < k; ++i) {
        // index 0 is the point itself
        const std::size_t rank = i < dense ? i + 1 : dense + (i - dense + 1) * (count - dense) / sparse;
        selection.indices.push_back(indices[rank]);
    }
    // The farthest is on the next line or beyond, or isLine would reject the selection: the gap is narrower.
    selection.spacing = std::sqrt(squared[count]) * 0.3f;
    return selection;
}

void adopt(NeighborLists& lists, std::size_t point, const Selection& selection) {
    std::copy(selection.indices.begin(), selection.indices.end(),
              lists.indices.begin() + std::ptrdiff_t(point * lists.k));
    lists.spacings[point] = selection.spacing;
    lists.thinned[point] = 1;
}

void widen(NeighborLists& lists, const PointSet& points, const NearestSearch& search, std::size_t point) {
    for (const std::size_t factor : {4, 16}) {
        const std::size_t count = factor * lists.k;
        if (count >= points.size()) return;
        const Selection selection = selectFrom(search, points, point, lists.k, count);
        if (isLine(momentsOf(points, selection.indices, point))) continue;
        adopt(lists, point, selection);
        return;
    }
}

} // namespace

void widenLineNeighborhoods(NeighborLists& lists, const PointSet& points, const NearestSearch& search,
                            const StageShare& share) {
    forEach(points.size(), share, [&](std::size_t i) {
        if (isLine(momentsOf(points, lists.of(i), i))) widen(lists, points, search, i);
    });
}

} // namespace pointrt::surface
