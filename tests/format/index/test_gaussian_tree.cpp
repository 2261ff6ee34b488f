// SPDX-License-Identifier: Apache-2.0
// The octree of Gaussians: wherever a Gaussian counts, the node there lists it, once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "format/index/gaussian_tree.h"

namespace pointrt::test {

namespace {

pro_gaussian gaussian(std::array<double, 3> mean, std::array<float, 3> deviation, float opacity) {
    pro_gaussian g{};
    std::copy(mean.begin(), mean.end(), g.mean);
    std::copy(deviation.begin(), deviation.end(), g.deviation);
    g.rotation[0] = 1;
    g.opacity = opacity;
    return g;
}

/// Gaussians of all sizes and shapes, some reaching out of the cube.
std::vector<GaussianEllipsoid> randomEllipsoids(std::size_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    std::normal_distribution<float> normal;
    std::vector<GaussianEllipsoid> ellipsoids;
    for (std::size_t k = 0; k < count; ++k) {
        pro_gaussian g = gaussian({unit(random), unit(random), unit(random)}, {}, unit(random));
        for (float& each : g.deviation) each = std::exp2(-2 - 12 * unit(random));
        float squared = 0;
        for (float& each : g.rotation) each = normal(random);
        for (const float each : g.rotation) squared += each * each;
        for (float& each : g.rotation) each /= std::sqrt(squared);
        ellipsoids.push_back(ellipsoidOf(g));
    }
    return ellipsoids;
}

/// The nodes from the root down that hold a point.
std::vector<std::uint32_t> nodesAt(const GaussianTree& tree, const std::array<double, 3>& point) {
    std::vector<std::uint32_t> path{0};
    std::array<double, 3> low{};
    double edge = 1;
    while (tree.nodes[2 * path.back()] != 0) {
        edge /= 2;
        std::uint32_t slot = 0;
        for (std::size_t i = 0; i < 3; ++i)
            if (point[i] >= low[i] + edge) {
                slot |= 1u << i;
                low[i] += edge;
            }
        path.push_back(PRO_GROUP_SIZE * tree.nodes[2 * path.back()] + slot);
    }
    return path;
}

std::multiset<std::uint32_t> listedAt(const GaussianTree& tree, const std::vector<std::uint32_t>& nodes) {
    std::multiset<std::uint32_t> listed;
    for (const std::uint32_t node : nodes) {
        const std::uint32_t first = tree.nodes[2 * node + 1];
        const std::size_t end = node + 1 < tree.nodeCount() ? tree.nodes[2 * (node + 1) + 1] : tree.lists.size();
        listed.insert(tree.lists.begin() + first, tree.lists.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return listed;
}

TEST(GaussianTree, ListsEachGaussianOnceWhereItCounts) {
    const std::vector<GaussianEllipsoid> ellipsoids = randomEllipsoids(1000, 1);
    for (const int fineness : {0, 2}) {
        const GaussianTree tree = buildGaussianTree(ellipsoids, fineness);
        std::mt19937 random(2);
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> unit(0, 1);
        for (std::uint32_t g = 0; g < ellipsoids.size(); ++g)
            for (int sample = 0; sample < 20; ++sample) {
                std::array<double, 3> ball{normal(random), normal(random), normal(random)},
                    point = ellipsoids[g].center;
                const double length = std::hypot(ball[0], ball[1], ball[2]), radius = std::cbrt(unit(random)) / length;
                for (std::size_t k = 0; k < 3; ++k)
                    for (std::size_t i = 0; i < 3; ++i) point[i] += radius * ball[k] * ellipsoids[g].half_axes[k][i];
                const bool inside = std::all_of(point.begin(), point.end(), [](double x) { return x >= 0 && x < 1; });
                const bool counts = ellipsoids[g].half_axes[0] != std::array<float, 3>{};
                const auto nodes = inside ? nodesAt(tree, point) : std::vector<std::uint32_t>{0};
                EXPECT_EQ(listedAt(tree, nodes).count(g), counts ? 1u : 0u) << "Gaussian " << g;
            }
    }
}

TEST(GaussianTree, IsBreadthFirst) {
    const GaussianTree tree = buildGaussianTree(randomEllipsoids(500, 3), 1);
    ASSERT_EQ(tree.nodeCount() % PRO_GROUP_SIZE, 0u);
    std::uint32_t groups = 0, before = 0;
    for (std::uint32_t node = 0; node < tree.nodeCount(); ++node) {
        if (tree.nodes[2 * node] != 0) {
            EXPECT_EQ(tree.nodes[2 * node], ++groups);
        }
        EXPECT_GE(tree.nodes[2 * node + 1], before);
        before = tree.nodes[2 * node + 1];
    }
    EXPECT_EQ(PRO_GROUP_SIZE * (groups + 1), tree.nodeCount());
}

TEST(GaussianTree, ListsAtTheDepthOfTheSize) {
    // a ball whose ellipsoid is a quarter of the cube wide, in the middle of a cell of depth 2
    const float deviation = 0.124f / countedDeviations(1);
    const GaussianTree tree = buildGaussianTree(
        std::vector{ellipsoidOf(gaussian({0.375, 0.375, 0.375}, {deviation, deviation, deviation}, 1))}, 0);
    EXPECT_EQ(tree.lists, std::vector<std::uint32_t>{0});
    EXPECT_EQ(nodesAt(tree, {0.375, 0.375, 0.375}).size(), 3u);
}

TEST(GaussianTree, OfNothingIsARoot) {
    const GaussianTree tree = buildGaussianTree({}, 0);
    EXPECT_EQ(tree.nodeCount(), PRO_GROUP_SIZE);
    EXPECT_TRUE(tree.lists.empty());
}

TEST(GaussianTree, FaintOnesCountNowhere) {
    EXPECT_EQ(countedDeviations(0.0039f), 0);
    EXPECT_NEAR(countedDeviations(1), std::sqrt(2 * std::log(255.0)), 1e-6);
    const GaussianTree tree =
        buildGaussianTree(std::vector{ellipsoidOf(gaussian({0.5, 0.5, 0.5}, {0.1f, 0.1f, 0.1f}, 0.003f))}, 0);
    EXPECT_TRUE(tree.lists.empty());
}

} // namespace

} // namespace pointrt::test
