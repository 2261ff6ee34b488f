// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "preprocess/surface/nearest_cache.h"
#include "preprocess/surface/neighbors.h"

namespace pointrt::test {
namespace {

using namespace surface;
using Ranked = std::vector<std::pair<float, std::uint32_t>>;

/// So many points that several threads share them: scattered ones, a line, a clump, and a grid whose points tie.
std::vector<Vec3f> unevenPoints() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(0, 1);
    std::vector<Vec3f> points;
    for (int i = 0; i < 6000; ++i) points.emplace_back(place(random), place(random), place(random));
    for (int i = 0; i < 2000; ++i) points.emplace_back(place(random), 0.5f, 0.25f);
    for (int i = 0; i < 1000; ++i) points.push_back(Vec3f(3, 3, 3) + 1e-4f * points[std::size_t(i)]);
    for (int i = 0; i < 4096; ++i) points.emplace_back(float(i % 16), float(i / 16 % 16), float(i / 256));
    std::shuffle(points.begin(), points.end(), random);
    return points;
}

/// Queries in the cloud, at its points, and outside.
std::vector<Vec3f> queriesFor(const std::vector<Vec3f>& points) {
    std::vector<Vec3f> queries{{-5, 2, 2}, {20, 20, 20}, {8, 8, -0.5f}, {3, 3, 3}, {0.5f, 0.5f, 0.25f}};
    for (std::size_t i = 0; i < points.size(); i += 131) queries.push_back(points[i]);
    return queries;
}

Ranked rankedByDistance(const std::vector<Vec3f>& points, const Vec3f& from) {
    Ranked all;
    for (std::uint32_t i = 0; i < points.size(); ++i) all.emplace_back(squaredDistance(from, points[i]), i);
    std::sort(all.begin(), all.end());
    return all;
}

TEST(NearestSearch, FindsTheNearestAndBreaksTies) {
    const std::vector<Vec3f> points = unevenPoints();
    const NearestSearch search(points);
    std::array<std::uint32_t, 20> indices;
    std::array<float, 20> squared;
    for (const Vec3f& query : queriesFor(points)) {
        const Ranked ranked = rankedByDistance(points, query);
        ASSERT_EQ(search.nearest(query, indices, squared), 20u);
        for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(std::pair(squared[i], indices[i]), ranked[i]);
        const float limit = ranked[7].first; // points at the limit are not below it
        const auto nearer = std::lower_bound(ranked.begin(), ranked.end(), std::pair(limit, 0u)) - ranked.begin();
        EXPECT_EQ(search.nearest(query, indices, squared, limit), std::size_t(nearer));
    }
}

TEST(NearestSearch, FindsAllWithin) {
    const std::vector<Vec3f> points = unevenPoints();
    const NearestSearch search(points);
    for (const Vec3f& query : queriesFor(points)) {
        const Ranked ranked = rankedByDistance(points, query);
        const float limit = ranked[300].first;
        std::vector<std::uint32_t> expected;
        for (const auto& [squared, index] : ranked)
            if (squared < limit) expected.push_back(index);
        std::vector<std::uint32_t> found(expected.size());
        ASSERT_EQ(search.within(query, limit, found), found.size());
        std::sort(expected.begin(), expected.end());
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected);
    }
}

/// Queries along a curve through the cloud: steps much shorter than the point spacing, then jumps.
std::vector<Vec3f> placesAlong(const std::vector<Vec3f>& points) {
    std::vector<Vec3f> places;
    for (std::size_t i = 0; i + 1 < points.size(); i += 997)
        for (int step = 0; step < 12; ++step)
            places.push_back(points[i] + float(step) / 300 * (points[i + 1] - points[i]));
    for (int repeat = 0; repeat < 3; ++repeat) places.push_back({3, 3, 3}); // a point of the grid, in the clump
    return places;
}

TEST(NearestCache, FindsWhatSingleSearchesFind) {
    const std::vector<Vec3f> points = unevenPoints();
    const NearestSearch search(points);
    for (const std::size_t wanted : {1u, 4u, 24u}) {
        NearestCache cache(search, points);
        std::vector<std::uint32_t> expected(wanted), found(wanted);
        std::vector<float> expected_squared(wanted), found_squared(wanted);
        for (const Vec3f& place : placesAlong(points)) {
            ASSERT_EQ(search.nearest(place, expected, expected_squared), wanted);
            ASSERT_EQ(cache.nearest(place, found, found_squared), wanted);
            EXPECT_EQ(found, expected);
            EXPECT_EQ(found_squared, expected_squared);
        }
    }
}

TEST(NearestCache, StopsBelowTheLimit) {
    const std::vector<Vec3f> points = unevenPoints();
    const NearestSearch search(points);
    NearestCache cache(search, points);
    std::array<std::uint32_t, 6> expected, found;
    std::array<float, 6> expected_squared, found_squared;
    for (const Vec3f& place : placesAlong(points)) {
        const float limit = rankedByDistance(points, place)[4].first; // a point is at the limit, so not below it
        const std::size_t count = search.nearest(place, expected, expected_squared, limit);
        ASSERT_EQ(cache.nearest(place, found, found_squared, limit), count);
        EXPECT_TRUE(std::equal(found.begin(), found.begin() + std::ptrdiff_t(count), expected.begin()));
    }
}

TEST(NearestCache, FindsPointsAtNoDistance) {
    std::vector<Vec3f> points(400, Vec3f(0.25f, 0.5f, 0.75f)); // fewer than a cache holds, more than requested
    points.resize(500, Vec3f(1, 1, 1));
    const NearestSearch search(points);
    NearestCache cache(search, points);
    std::array<std::uint32_t, 3> found;
    std::array<float, 3> squared;
    for (int repeat = 0; repeat < 3; ++repeat) {
        ASSERT_EQ(cache.nearest(points[0], found, squared), 3u);
        EXPECT_EQ(squared, (std::array<float, 3>{0, 0, 0}));
        EXPECT_LT(std::max({found[0], found[1], found[2]}), 400u);
    }
}

TEST(NearestSearch, ReportsWhatDoesNotFitAndWritesNoMore) {
    const std::vector<Vec3f> points = unevenPoints();
    const NearestSearch search(points);
    for (const std::size_t room : {0u, 1u, 23u, 100u}) {
        std::vector<std::uint32_t> found(room + 1, 12345);
        EXPECT_EQ(search.within({3, 3, 3}, 1, {found.data(), room}), room + 1);
        EXPECT_EQ(found[room], 12345u);
    }
}

TEST(NearestSearch, FewPoints) {
    std::array<std::uint32_t, 3> indices;
    std::array<float, 3> squared;
    const std::vector<Vec3f> one{{1, 2, 3}}, equal_points(1000, Vec3f(1, 1, 1));
    EXPECT_EQ(NearestSearch(one).nearest({1, 2, 4}, indices, squared), 1u);
    EXPECT_EQ(indices[0], 0u);
    EXPECT_EQ(squared[0], 1);
    const NearestSearch equal(equal_points); // no cut can separate them
    EXPECT_EQ(equal.nearest({1, 1, 1}, indices, squared), 3u);
    EXPECT_EQ(squared, (std::array<float, 3>{0, 0, 0}));
}

} // namespace
} // namespace pointrt::test
