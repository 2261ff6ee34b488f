// SPDX-License-Identifier: Apache-2.0
#include "runtime/measure/contour_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "runtime/measure/contour_files.h"

namespace pointrt {
namespace {

HeightRaster rasterOf(std::size_t columns, std::size_t rows, const std::function<double(double, double)>& height) {
    HeightRaster raster{columns, rows, {}};
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column)
            raster.heights.push_back(height(static_cast<double>(column), static_cast<double>(row)));
    return raster;
}

/// Twice the area that a closed line encloses, positive if it goes counterclockwise.
double areaOf(const ContourLine& line) {
    double sum = 0;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        const RasterPoint &a = line.points[i], &b = line.points[(i + 1) % line.points.size()];
        sum += (a.column * b.row - b.column * a.row) / 2;
    }
    return sum;
}

TEST(ContourLines, OfASlopeAreStraight) {
    const auto lines = contourLines(rasterOf(6, 4, [](double x, double) { return 2 * x; }), 5);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_FALSE(lines[0].closed);
    ASSERT_EQ(lines[0].points.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(lines[0].points[i], (RasterPoint{2.5, 3.0 - static_cast<double>(i)})) << "high ground is in the east";
}

TEST(ContourLines, OfAHillGoCounterclockwise) {
    const auto cone = rasterOf(101, 101, [](double x, double y) { return 40 - std::hypot(x - 50, y - 50); });
    const auto hill = contourLines(cone, 10.5);
    ASSERT_EQ(hill.size(), 1u);
    EXPECT_TRUE(hill[0].closed);
    EXPECT_NEAR(areaOf(hill[0]), std::numbers::pi * 29.5 * 29.5, 2) << "linear between nodes";
    for (const RasterPoint& point : hill[0].points)
        EXPECT_NEAR(std::hypot(point.column - 50, point.row - 50), 29.5, 0.01);
    const auto pit =
        contourLines(rasterOf(101, 101, [](double x, double y) { return std::hypot(x - 50, y - 50); }), 29.5);
    ASSERT_EQ(pit.size(), 1u);
    EXPECT_LT(areaOf(pit[0]), 0);
}

TEST(ContourLines, EndWhereHeightsAreMissing) {
    const auto lines =
        contourLines(rasterOf(9, 9, [](double x, double y) { return x == 4 && y == 4 ? std::nan("") : x + 0.5; }), 4);
    ASSERT_EQ(lines.size(), 2u);
    for (const ContourLine& line : lines) EXPECT_EQ(line.points.size(), 4u);
}

TEST(ContourLines, SaddlesAreDecidedByTheirMean) {
    const auto square = [](double a, double b, double c, double d) { return HeightRaster{2, 2, {a, b, c, d}}; };
    const auto high = contourLines(square(9, 0, 0, 9), 4); // mean 4.5: the high corners are joined
    const auto low = contourLines(square(9, 0, 0, 9), 5);
    ASSERT_EQ(high.size(), 2u);
    ASSERT_EQ(low.size(), 2u);
    EXPECT_EQ(high[0].points[0].row, 0) << "from the lower side";
    EXPECT_EQ(high[0].points[1].column, 1) << "around the lower right corner";
    EXPECT_EQ(low[0].points[1].column, 0) << "around the lower left corner";
}

TEST(ContourLines, NoneAtOtherLevels) {
    const HeightRaster level = rasterOf(5, 5, [](double, double) { return 3; });
    EXPECT_TRUE(contourLines(level, 3).empty()) << "nodes at the level count as above it";
    EXPECT_TRUE(contourLines(level, 4).empty());
    EXPECT_TRUE(contourLines(HeightRaster{}, 1).empty());
    EXPECT_TRUE(contourLines(HeightRaster{1, 1, {2}}, 1).empty());
}

/// Each crossing is on exactly one line, for any ground.
TEST(ContourLines, RandomGroundIsComplete) {
    std::mt19937 random(7);
    for (int round = 0; round < 50; ++round) {
        const auto raster = rasterOf(20, 17, [&](double, double) {
            const auto step = static_cast<double>(random() % 8);
            return step == 7 ? std::nan("") : step;
        });
        std::size_t crossings = 0, points = 0;                           // of sides of squares with four heights
        const auto inSquare = [&](std::size_t column, std::size_t row) { // in a square, named by its lower left node
            if (column + 1 >= raster.columns || row + 1 >= raster.rows) return false;
            return !std::isnan(raster.at(column, row) + raster.at(column + 1, row) + raster.at(column, row + 1) +
                               raster.at(column + 1, row + 1));
        };
        const auto differ = [](double a, double b) { return (a >= 3) != (b >= 3); };
        for (std::size_t row = 0; row < raster.rows; ++row)
            for (std::size_t column = 0; column < raster.columns; ++column) {
                const bool here = inSquare(column, row), below = row > 0 && inSquare(column, row - 1),
                           before = column > 0 && inSquare(column - 1, row);
                if ((here || below) && differ(raster.at(column, row), raster.at(column + 1, row))) ++crossings;
                if ((here || before) && differ(raster.at(column, row), raster.at(column, row + 1))) ++crossings;
            }
        for (const ContourLine& line : contourLines(raster, 3)) {
            EXPECT_GE(line.points.size(), 2u);
            points += line.points.size();
        }
        EXPECT_EQ(points, crossings);
    }
}

TEST(ContourFiles, HoldTheLines) {
    ContourDrawing drawing;
    drawing.contours = {{10, true, true, {{0, 0, 10}, {100, 0, 10}, {50, 80, 10}}},
                        {12, false, false, {{20, 20, 12}, {40, 60, 12}}}};
    drawing.unit = "m";
    drawing.epsg = 2056;
    const std::string dxf = contourDxf(drawing), geo = contourGeoJson(drawing), svg = contourSvg(drawing);
    EXPECT_NE(dxf.find("index_contours"), std::string::npos);
    EXPECT_NE(dxf.find("8\ncontours"), std::string::npos);
    EXPECT_NE(geo.find("\"height\":12.000"), std::string::npos) << geo;
    EXPECT_NE(geo.find("2056"), std::string::npos);
    EXPECT_EQ(geo.find("Polygon"), std::string::npos) << "closed lines are lines";
    EXPECT_NE(svg.find("<polygon"), std::string::npos);
    EXPECT_NE(svg.find("<polyline"), std::string::npos);
    EXPECT_NE(svg.find(">10</text>"), std::string::npos) << svg;
    EXPECT_NE(svg.find(" m</text>"), std::string::npos) << "the scale bar";
    EXPECT_EQ(contourSvg({}).find("nan"), std::string::npos);
}

} // namespace
} // namespace pointrt
