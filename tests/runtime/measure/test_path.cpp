// SPDX-License-Identifier: Apache-2.0
// Measures with known answers, in national coordinates.
#include "runtime/measure/path_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

namespace pointrt {
namespace {

constexpr Position kVertical{0, 0, 1};
constexpr Position kCorner{2'635'812.75, 1'182'340.5, 431.25}; // LV95

std::vector<Position> placed(std::vector<Position> points) {
    for (Position& point : points)
        for (std::size_t axis = 0; axis < 3; ++axis) point[axis] += kCorner[axis];
    return points;
}

TEST(MeasurePath, DistanceAndHeight) {
    const PathMeasures measures = measurePath(placed({{0, 0, 0}, {3, 4, 12}}), kVertical);
    EXPECT_NEAR(measures.length, 13, 1e-8);
    EXPECT_NEAR(measures.last_leg, 13, 1e-8);
    EXPECT_NEAR(measures.horizontal, 5, 1e-8);
    EXPECT_NEAR(measures.slope_deg, std::atan2(12, 5) * 180 / std::numbers::pi, 1e-8);
    EXPECT_NEAR(measures.height, 12, 1e-8);
    EXPECT_EQ(measures.difference, (Position{3, 4, 12}));
    EXPECT_FALSE(measures.angle_deg || measures.area);
    EXPECT_NEAR(measurePath(placed({{0, 0, 0}, {3, 4, 12}}), {0, -1, 0}).height, -4, 1e-8) << "another up";
}

TEST(MeasurePath, PathsHaveAnglesAndAreas) {
    const PathMeasures roof = measurePath(placed({{0, 0, 0}, {4, 0, 0}, {4, 4, 3}, {0, 4, 3}}), kVertical);
    EXPECT_NEAR(roof.length, 4 + 5 + 4, 1e-8);
    EXPECT_NEAR(roof.horizontal_length, 4 + 4 + 4, 1e-8);
    EXPECT_NEAR(*roof.perimeter, 4 + 5 + 4 + 5, 1e-8);
    EXPECT_NEAR(*roof.angle_deg, 90, 1e-7);
    EXPECT_NEAR(*roof.area, 20, 1e-7) << "4 by 5, tilted";
    EXPECT_NEAR(*roof.plan_area, 16, 1e-7);
    const double third = 2 * std::numbers::pi / 3;
    const auto corner = [&](int n) { return Position{std::cos(n * third), std::sin(n * third), 0}; };
    const PathMeasures triangle = measurePath(placed({corner(0), corner(1), corner(2)}), kVertical);
    EXPECT_NEAR(*triangle.angle_deg, 60, 1e-6);
    EXPECT_NEAR(*triangle.area, 0.75 * std::sqrt(3), 1e-8);
    const std::vector<Position> l_shape = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    EXPECT_NEAR(*measurePath(placed(l_shape), kVertical).area, 3, 1e-7) << "not convex";
    EXPECT_NEAR(*measurePath(placed({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), kVertical).angle_deg, 180, 1e-7);
}

MeasuredPath squarePath() {
    MeasuredPath path{placed({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}}), {}, 4};
    path.measures = measurePath(path.points, kVertical);
    return path;
}

TEST(MeasurePath, FilesHaveTheScansCoordinates) {
    EXPECT_EQ(pathCsv(squarePath()), "point,x,y,z,length\n"
                                     "1,2635812.7500,1182340.5000,431.2500,0.0000\n"
                                     "2,2635814.7500,1182340.5000,431.2500,2.0000\n"
                                     "3,2635814.7500,1182342.5000,431.2500,4.0000\n");
    const auto json = nlohmann::json::parse(pathGeoJson(squarePath()));
    EXPECT_EQ(json["type"], "FeatureCollection");
    const auto &line = json["features"][0], &polygon = json["features"][1];
    EXPECT_EQ(line["geometry"]["type"], "LineString");
    EXPECT_EQ(line["geometry"]["coordinates"][2], (std::vector<double>{2635814.75, 1182342.5, 431.25}));
    EXPECT_EQ(line["properties"]["length"], 4);
    const auto& ring = polygon["geometry"]["coordinates"][0];
    EXPECT_EQ(ring.size(), 4u);
    EXPECT_EQ(ring.front(), ring.back()) << "a polygon is closed";
    EXPECT_EQ(polygon["properties"]["area"], 2);
}

TEST(MeasurePath, DxfHasAVertexForEachPoint) {
    const std::string text = pathDxf(squarePath());
    std::size_t vertices = 0;
    for (std::size_t at = 0; (at = text.find("0\nVERTEX\n", at)) != std::string::npos; ++at) ++vertices;
    EXPECT_EQ(vertices, 3u);
    EXPECT_NE(text.find("10\n2635814.7500\n20\n1182342.5000\n30\n431.2500\n"), std::string::npos);
    EXPECT_TRUE(text.starts_with("0\nSECTION\n") && text.ends_with("0\nENDSEC\n0\nEOF\n"));
}

} // namespace
} // namespace pointrt
