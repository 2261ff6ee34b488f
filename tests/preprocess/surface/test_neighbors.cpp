// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "preprocess/surface/point_graph.h"
#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

using namespace surface;

const StageProgress kSilent;

TEST(Neighbors, AreTheNearestByBruteForce) {
    const PointSet points = takePoints(randomTorus(700).cloud());
    const NearestSearch search(points.positions);
    const NeighborLists lists = findNeighbors(points, search, 16, {kSilent, "test"});
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        std::vector<std::pair<float, std::uint32_t>> all;
        for (std::uint32_t j = 0; j < points.size(); ++j)
            if (j != i) all.emplace_back((points.positions[i] - points.positions[j]).squaredNorm(), j);
        std::sort(all.begin(), all.end());
        for (std::size_t n = 0; n < 16; ++n) {
            EXPECT_EQ(lists.of(i)[n], all[n].second);
            EXPECT_NEAR(lists.distance(points, i, n), std::sqrt(all[n].first), 1e-6);
        }
    }
}

TEST(Neighbors, TiesGoToTheLowerIndex) {
    const PointSet points = takePoints(gridPlane(20).cloud());
    const NearestSearch search(points.positions);
    std::vector<std::uint32_t> indices(3);
    std::vector<float> squared(3);
    for (std::size_t i = 0; i < points.size(); ++i) {
        search.nearest(points.positions[i], indices, squared);
        const auto as_near = [&](std::uint32_t j) {
            return j != i && (points.positions[i] - points.positions[j]).squaredNorm() == squared[1];
        };
        for (std::uint32_t j = 0; j < indices[1]; ++j) EXPECT_FALSE(as_near(j));
    }
}

/// Block searches must find the same lists as single searches, ties included.
void expectListsOfSingleSearches(const Shape& shape, std::size_t k) {
    const PointSet points = takePoints(shape.cloud());
    const NearestSearch search(points.positions);
    const NeighborLists lists = findNeighbors(points, search, k, {kSilent, "test"});
    std::vector<std::uint32_t> indices(k + 1);
    std::vector<float> squared(k + 1);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        search.nearest(points.positions[i], indices, squared);
        indices.erase(std::find(indices.begin(), indices.end(), i));
        const auto listed = lists.of(i);
        EXPECT_TRUE(std::equal(listed.begin(), listed.end(), indices.begin(), indices.end())) << i;
        indices.resize(k + 1);
    }
}

TEST(Neighbors, ListsAreThoseOfSingleSearches) {
    expectListsOfSingleSearches(gridPlane(60), 16); // nearly all distances are ties
    expectListsOfSingleSearches(randomTorus(5000), 7);
    expectListsOfSingleSearches(randomTorus(2000), 255);
}

TEST(Neighbors, ListsBesideGapsToo) { // blocks span the gaps
    Shape shape = randomSphere(3000);
    for (std::size_t i = 0; i < shape.positions.size(); ++i)
        shape.positions[i] = i % 3 == 0 ? Vec3f(shape.positions[i] * 1e-4f) : Vec3f(shape.positions[i] * 50);
    shape.add(Vec3d(1e4, 0, 0), Vec3d::UnitX());
    expectListsOfSingleSearches(shape, 16);
}

TEST(Neighbors, WithinFindsAllOrReportsThatTheyDoNotFit) {
    const PointSet points = takePoints(gridPlane(20).cloud());
    const NearestSearch search(points.positions);
    const Vec3f query = points.positions[150];
    std::vector<std::uint32_t> expected;
    const float squared_radius = 0.04f;
    for (std::uint32_t i = 0; i < points.size(); ++i)
        if (squaredDistance(points.positions[i], query) < squared_radius) expected.push_back(i);
    ASSERT_GT(expected.size(), 10u);
    std::vector<std::uint32_t> found(expected.size());
    ASSERT_EQ(search.within(query, squared_radius, found), expected.size());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    found.pop_back();
    EXPECT_EQ(search.within(query, squared_radius, found), found.size() + 1);
}

TEST(Neighbors, SmallCloudsListAllOthers) {
    const PointSet points = takePoints(randomSphere(5).cloud());
    const NearestSearch search(points.positions);
    const NeighborLists lists = findNeighbors(points, search, 16, {kSilent, "test"});
    EXPECT_EQ(lists.k, 4u);
    for (std::size_t i = 0; i < 5; ++i) {
        const auto others = lists.of(i);
        EXPECT_EQ(std::accumulate(others.begin(), others.end(), std::size_t(0)) + i, 10u);
    }
}

TEST(PointGraph, ListsAfterDroppingPointsEqualThoseFoundAnew) {
    PointGraph graph;
    graph.points = takePoints(randomTorus(3000).cloud());
    graph.connect(16, {kSilent, "test"});
    std::vector<std::uint8_t> keep(graph.points.size(), 1);
    for (std::size_t i = 0; i < keep.size(); i += 37) keep[i] = 0;
    graph.keep(keep);
    const NeighborLists fresh = findNeighbors(graph.points, *graph.search, 16, {kSilent, "test"});
    EXPECT_EQ(graph.lists.indices, fresh.indices);
    EXPECT_EQ(graph.lists.spacings, fresh.spacings);
    EXPECT_EQ(graph.lists.thinned, fresh.thinned);
}

} // namespace
} // namespace pointrt::test
