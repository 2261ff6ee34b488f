// SPDX-License-Identifier: Apache-2.0
// Row operations change all columns of a point set alike.
#include "preprocess/surface/point_set.h"

#include <gtest/gtest.h>

#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

using namespace surface;

/// A value that depends on its row and column.
template <typename Value>
Value valueAt(std::size_t column, std::uint32_t row) {
    const auto number = std::uint8_t(10 * column + row);
    if constexpr (std::is_arithmetic_v<Value>)
        return Value(number);
    else if constexpr (std::is_same_v<Value, Rgb8>)
        return {number, 1, 2};
    else
        return Value(float(number), 1, 2);
}

/// Calls body(number, column) for all columns.
template <typename Body>
void forNumbered(PointSet& points, const Body& body) {
    std::size_t number = 0;
    std::apply([&](auto&... column) { (body(number++, column), ...); }, points.columns());
}

/// Points whose columns hold these rows; every column but the one of number `empty`.
PointSet withRows(const std::vector<std::uint32_t>& rows, std::size_t empty) {
    PointSet points;
    forNumbered(points, [&]<typename Value>(std::size_t number, std::vector<Value>& column) {
        for (const std::uint32_t row : rows)
            if (number != empty) column.push_back(valueAt<Value>(number, row));
    });
    return points;
}

void expectSame(PointSet& points, PointSet expected, std::size_t empty) {
    EXPECT_TRUE(points.columns() == expected.columns()) << "column " << empty << " was empty";
}

/// Calls check(empty) for each column left empty in turn.
template <typename Check>
void forEachEmpty(const Check& check) {
    for (std::size_t empty = 0; empty < std::tuple_size_v<decltype(PointSet().columns())>; ++empty) check(empty);
}

TEST(PointSet, KeepsRowsOfAllColumns) {
    forEachEmpty([](std::size_t empty) {
        PointSet points = withRows({0, 1, 2, 3, 4}, empty);
        keepRows(points, {0, 1, 1, 0, 1});
        expectSame(points, withRows({1, 2, 4}, empty), empty);
    });
}

TEST(PointSet, AppendsCopiesOfRows) {
    forEachEmpty([](std::size_t empty) {
        PointSet points = withRows({0, 1, 2}, empty);
        appendRows(points, {2, 0, 2});
        expectSame(points, withRows({0, 1, 2, 2, 0, 2}, empty), empty);
    });
}

TEST(PointSet, SelectsRowsInOrder) {
    forEachEmpty([](std::size_t empty) {
        PointSet points = withRows({0, 1, 2, 3}, empty);
        selectRows(points, {3, 1, 0});
        expectSame(points, withRows({3, 1, 0}, empty), empty);
    });
}

TEST(PointSet, LeftOutPointsKeepTheOthersIndices) {
    const Shape shape = randomSphere(500);
    std::vector<Vec3f> positions = shape.positions;
    positions.insert(positions.begin() + 100, Vec3f(9, 9, 9));
    Cloud cloud;
    cloud.positions = positions;
    for (std::size_t i = 0; i < positions.size(); ++i)
        cloud.colors.push_back({std::uint8_t(i), std::uint8_t(i >> 8), 0});
    const PointSet alone = takePoints(shape.cloud()), points = takePoints(std::move(cloud), {100});
    EXPECT_EQ(points.positions, alone.positions);
    ASSERT_EQ(points.input_index.size(), 500u);
    for (std::size_t i = 0; i < 500; ++i) {
        EXPECT_EQ(points.input_index[i], alone.input_index[i] + (alone.input_index[i] >= 100));
        EXPECT_EQ(points.colors[i][0], std::uint8_t(points.input_index[i]));
    }
}

} // namespace
} // namespace pointrt::test
