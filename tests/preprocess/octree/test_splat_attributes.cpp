// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "preprocess/octree/splat_attributes.h"

namespace pointrt {
namespace {

Attribute bytes(const std::string& name, std::uint32_t components, const std::vector<char>& values) {
    return {name, Scalar::kU8, components, values};
}

TEST(SplatAttributes, FollowTheSplats) {
    std::vector<Attribute> attributes{bytes("a", 1, {10, 11, 12, 13}),
                                      bytes("b", 3, {0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9})};
    const std::vector<Attribute> gathered = gatherAttributes(attributes, {3, 1});
    ASSERT_EQ(gathered.size(), 2u);
    EXPECT_EQ(gathered[0].values, (std::vector<char>{13, 11}));
    EXPECT_EQ(gathered[1].values, (std::vector<char>{7, 8, 9, 1, 2, 3}));
    EXPECT_TRUE(attributes[1].values.empty()) << "arrays are freed one by one";
}

TEST(SplatAttributes, SplatsThatFillGapsFollowAPoint) {
    PackedSplats splats;
    splats.input_index = {3, 102, 0, 100, 99};
    EXPECT_EQ(sourcePoints(splats), splats.input_index) << "no splat fills a gap";
    splats.input_count = 100;
    splats.filled_from = {7, 8, 9};
    splats.filled = 2;
    EXPECT_EQ(sourcePoints(splats), (std::vector<std::uint32_t>{3, 9, 0, 7, 99}));
}

TEST(SplatAttributes, SupportAllSizes) {
    for (const Scalar type : {Scalar::kI8, Scalar::kU16, Scalar::kF32, Scalar::kF64}) {
        const std::size_t size = scalarSize(type);
        std::vector<char> values;
        for (std::size_t i = 0; i < 5 * size; ++i) values.push_back(static_cast<char>(i));
        std::vector<Attribute> attributes{{"a", type, 1, values}};
        const std::vector<Attribute> gathered = gatherAttributes(attributes, {4, 0});
        EXPECT_EQ(std::string(gathered[0].values.begin(), gathered[0].values.end()),
                  std::string(values.end() - std::ptrdiff_t(size), values.end()) +
                      std::string(values.begin(), values.begin() + std::ptrdiff_t(size)));
    }
}

TEST(SplatAttributes, NamesFitTheFile) {
    Cloud cloud;
    cloud.scans.push_back({"a.ply", {}});
    const std::string long_name(40, 'n'), wide = std::string(30, 'w') + "\xC3\xA9";
    for (const std::string& name :
         {std::string("plain"), long_name, long_name, wide, std::string("a\nb"), std::string()})
        cloud.attributes.push_back(bytes(name, 1, {}));
    fitAttributes(cloud);
    std::vector<std::string> names;
    for (const Attribute& each : cloud.attributes) names.push_back(each.name);
    EXPECT_EQ(names, (std::vector<std::string>{"plain", std::string(31, 'n'), std::string(29, 'n') + "_2",
                                               std::string(30, 'w'), "a\\nb", "unnamed"}));
    EXPECT_EQ(cloud.notes.size(), 5u) << "one per changed attribute";
}

TEST(SplatAttributes, AreLimitedToThoseOfAFile) {
    Cloud cloud;
    for (int i = 0; i < 40; ++i) cloud.attributes.push_back(bytes(std::to_string(i), 1, {}));
    fitAttributes(cloud);
    EXPECT_EQ(cloud.attributes.size(), PRO_ATTRIBUTE_MAX);
    EXPECT_EQ(cloud.notes.size(), 1u);
}

TEST(SplatAttributes, SensorsOfScans) {
    EXPECT_TRUE(sensorRows({{"a", {}}, {"b", {}}}).empty());
    EXPECT_EQ(sensorRows({{"a", {}}, {"b", Vec3d(1, 2, 3)}}), (std::vector<double>{0, 0, 0, 0, 1, 2, 3, 1}));
}

} // namespace
} // namespace pointrt
