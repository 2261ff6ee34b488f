// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/surface/lines.h"

#include "preprocess/surface/plane_fit.h"

namespace pointrt::surface {
namespace {

/// Whether points spread along a line ten times further than across it. Of a covariance with the eigenvalues
/// a >> b, c the second invariant over the trace squared is (b + c) / a: no eigenvalue needs to be found.
bool isLine(const Moments& moments) {
    constexpr double kLine = 1.0 / (10 * 10);
    const auto& [xx, xy, xz, yy, yz, zz] = moments.covariance;
    const double trace = double(xx) + yy + zz;
    const double invariant =
        double(xx) * yy + double(xx) * zz + double(yy) * zz - double(xy) * xy - double(xz) * xz - double(yz) * yz;
    return invariant < kLine * trace * trace;
}

/// Neighbours of one point out of a wider search.
struct Choice {
    std::vector<std::uint32_t> indices;
    float spacing = 0;
};

/// Picks k of the nearest count: the first k / 2 + 1, then at even steps up to the last.
Choice chooseFrom(const NearestSearch& search, const Points& points, std::size_t point, std::size_t k,
                  std::size_t count) {
    std::vector<std::uint32_t> indices(count + 1);
    std::vector<float> squared(count + 1);
    search.nearest(points.positions[point], indices, squared);
    Choice choice;
    const std::size_t dense = k / 2 + 1, sparse = k - dense;
    for (std::size_t i = 0; i < k; ++i) {
        // The nearest, number 0, is the point itself.
        const std::size_t rank = i < dense ? i + 1 : dense + (i - dense + 1) * (count - dense) / sparse;
        choice.indices.push_back(indices[rank]);
    }
    // The farthest is on the next line or beyond, or isLine would not let the choice pass: the gap is shorter.
    choice.spacing = std::sqrt(squared[count]) * 0.3f;
    return choice;
}

void adopt(NeighborLists& lists, std::size_t point, const Choice& choice) {
    std::copy(choice.indices.begin(), choice.indices.end(), lists.indices.begin() + std::ptrdiff_t(point * lists.k));
    lists.spacings[point] = choice.spacing;
    lists.thinned[point] = 1;
}

void spreadLine(NeighborLists& lists, const Points& points, const NearestSearch& search, std::size_t point) {
    for (const std::size_t factor : {4, 16}) {
        const std::size_t count = factor * lists.k;
        if (count >= points.size()) return;
        const Choice choice = chooseFrom(search, points, point, lists.k, count);
        if (isLine(momentsOf(points, choice.indices, point))) continue;
        adopt(lists, point, choice);
        return;
    }
}

} // namespace

void spreadLines(NeighborLists& lists, const Points& points, const NearestSearch& search, const StageShare& share) {
    forEach(points.size(), share, [&](std::size_t i) {
        if (isLine(momentsOf(points, lists.of(i), i))) spreadLine(lists, points, search, i);
    });
}

} // namespace pointrt::surface
