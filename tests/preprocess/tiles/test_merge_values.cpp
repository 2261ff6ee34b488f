// SPDX-License-Identifier: Apache-2.0
#include "preprocess/tiles/merge_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace pointrt {
namespace {

template <typename Number>
Attribute attribute(const std::string& name, Scalar type, const std::vector<Number>& values,
                    std::uint32_t components = 1) {
    Attribute made{name, type, components, std::vector<char>(values.size() * sizeof(Number))};
    std::memcpy(made.values.data(), values.data(), made.values.size());
    return made;
}

/// Merges the three splats of a tile, with areas 1, 2 and 4.
template <typename Number>
std::vector<Number> merged(const Attribute& values) {
    TileSplats tile;
    tile.attributes = {values};
    const std::vector<SplatsView> tiles{viewOf(tile)};
    const std::vector<MergeSource> members{{0, 0}, {0, 1}, {0, 2}};
    const std::vector<float> areas{1, 2, 4};
    std::vector<Number> to(values.components);
    mergeValue(tiles, 0, values, {members, areas}, reinterpret_cast<char*>(to.data()));
    return to;
}

TEST(MergeValues, NumbersAreMeansByArea) {
    EXPECT_EQ(merged<std::uint16_t>(attribute<std::uint16_t>("intensity", Scalar::kU16, {70, 0, 0})).front(), 10);
    EXPECT_EQ(merged<std::int8_t>(attribute<std::int8_t>("a", Scalar::kI8, {-4, -6, -5})).front(), -5); // -5.14
    EXPECT_EQ(merged<std::uint8_t>(attribute<std::uint8_t>("b", Scalar::kU8, {255, 255, 255})).front(), 255);
    EXPECT_DOUBLE_EQ(merged<double>(attribute<double>("gps_time", Scalar::kF64, {7, 14, 7})).front(), 9);
    const auto pair = merged<float>(attribute<float>("flow", Scalar::kF32, {7, 0, 0, 7, 0, 0}, 2));
    EXPECT_FLOAT_EQ(pair[0], 1);
    EXPECT_FLOAT_EQ(pair[1], 2);
}

TEST(MergeValues, CategoricalValuesAreThoseOfTheLargestArea) {
    EXPECT_EQ(merged<std::uint8_t>(attribute<std::uint8_t>("classification", Scalar::kU8, {2, 2, 6})).front(), 6);
    EXPECT_EQ(merged<std::uint8_t>(attribute<std::uint8_t>("classification", Scalar::kU8, {6, 2, 9})).front(), 9);
    EXPECT_EQ(merged<std::uint16_t>(attribute<std::uint16_t>("point_source_id", Scalar::kU16, {500, 9, 500})).front(),
              500);
    EXPECT_EQ(merged<std::uint64_t>(attribute<std::uint64_t>("id", Scalar::kU64, {1ull << 63, 5, 1ull << 63})).front(),
              1ull << 63);
}

TEST(MergeValues, NaNIsIgnored) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FLOAT_EQ(merged<float>(attribute<float>("heat", Scalar::kF32, {nan, 3, 6})).front(), 5);
    EXPECT_TRUE(std::isnan(merged<float>(attribute<float>("heat", Scalar::kF32, {nan, nan, nan})).front()));
}

TEST(MergeValues, ColorsAreMeansInLinearLight) {
    TileSplats tile;
    tile.colors = {{255, 10, 0}, {0, 10, 0}};
    const std::vector<SplatsView> tiles{viewOf(tile)};
    const std::vector<MergeSource> members{{0, 0}, {0, 1}};
    const std::vector<float> areas{1, 1};
    EXPECT_EQ(meanColor(tiles, {members, areas}), (Rgb8{188, 10, 0})); // half of full light is 188 in sRGB, not 128
    const auto wide = merged<std::uint16_t>(
        attribute<std::uint16_t>(kRgb16, Scalar::kU16, {65535, 100, 0, 65535, 100, 0, 0, 100, 0}, 3));
    EXPECT_NEAR(wide[0], 65535 * (1.055 * std::pow(3.0 / 7, 1 / 2.4) - 0.055), 1);
    EXPECT_EQ(wide[1], 100);
    EXPECT_EQ(wide[2], 0);
}

TEST(MergeValues, NoiseIsTheRootOfTheMeanSquare) {
    TileSplats noisy, clean;
    noisy.noise = {2, 4};
    const std::vector<SplatsView> tiles{viewOf(noisy), viewOf(clean)};
    const std::vector<MergeSource> members{{0, 0}, {0, 1}, {1, 0}};
    const std::vector<float> areas{1, 1, 2};
    EXPECT_FLOAT_EQ(meanNoise(tiles, {members, areas}), std::sqrt(5.0f));
}

} // namespace
} // namespace pointrt
