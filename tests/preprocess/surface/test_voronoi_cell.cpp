// SPDX-License-Identifier: Apache-2.0
#include "preprocess/surface/voronoi_cell.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pointrt::surface {
namespace {

using Eigen::Vector2f;

constexpr auto allCount = [](const Eigen::Vector2f&) { return true; };

TEST(VoronoiCell, SquareNeighborsGiveTheUnitCell) {
    VoronoiCell cell;
    cell.reset(10);
    for (const Vector2f& place : {Vector2f(1, 0), Vector2f(0, 1), Vector2f(-1, 0), Vector2f(0, -1)})
        EXPECT_TRUE(cell.clip(place, 0));
    EXPECT_EQ(cell.corners().size(), 4u);
    EXPECT_NEAR(cell.closedRadius(10, allCount), std::numbers::sqrt2 / 2, 1e-6);
    EXPECT_NEAR(cell.radius(), std::numbers::sqrt2 / 2, 1e-6);
    EXPECT_EQ(cell.closedRadius(0.7f, allCount), 0) << "all corners are further away";
    EXPECT_EQ(cell.closedRadius(10, [](const Eigen::Vector2f& place) { return place.x() > 1; }), 0);
    EXPECT_FALSE(cell.clip(Vector2f(2, 2), 0)) << "too far to cut";
}

TEST(VoronoiCell, OpenSidesDoNotCount) {
    VoronoiCell cell;
    cell.reset(10);
    EXPECT_EQ(cell.closedRadius(10, allCount), 0);
    cell.clip(Vector2f(1, 0), 0);
    cell.clip(Vector2f(-1, 0), 0);
    EXPECT_EQ(cell.closedRadius(10, allCount), 0) << "a strip has no corner";
    cell.clip(Vector2f(0, 1), 0);
    EXPECT_NEAR(cell.closedRadius(10, allCount), std::numbers::sqrt2 / 2, 1e-6);
    EXPECT_GT(cell.radius(), 10);
    EXPECT_TRUE(cell.isOpen());
    cell.clip(Vector2f(0, -1), 0);
    EXPECT_FALSE(cell.isOpen());
}

TEST(VoronoiCell, RepeatedCutsLeaveNoSliver) {
    VoronoiCell cell;
    cell.reset(3);
    const Vector2f place(0.12345f, 0.6789f);
    EXPECT_TRUE(cell.clip(place, 0));
    EXPECT_FALSE(cell.clip(place * 0.9999999f, 0));
    EXPECT_EQ(cell.closedRadius(10, allCount), 0);
}

TEST(VoronoiCell, NeighborsAroundAnEdgeCutAtTheEdge) {
    VoronoiCell cell;
    cell.reset(10);
    cell.clip(Vector2f(1, 0), -1); // the edge is at 1, the neighbour 1 below it
    float right = 0;
    for (const CellCorner& corner : cell.corners()) right = std::max(right, corner.place.x());
    EXPECT_NEAR(right, 1, 1e-6);
}

TEST(VoronoiCell, NeighborsDirectlyAboveCutNothing) {
    VoronoiCell cell;
    cell.reset(1);
    EXPECT_FALSE(cell.clip(Vector2f(0, 0), 0.1f));
    EXPECT_FALSE(cell.clip(Vector2f(1e-3f, 0), 0.1f));
}

} // namespace
} // namespace pointrt::surface
