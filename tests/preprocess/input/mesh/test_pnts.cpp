// SPDX-License-Identifier: Apache-2.0
// Point clouds of 3D Tiles.
#include <draco/compression/point_cloud/point_cloud_sequential_encoder.h>
#include <draco/point_cloud/point_cloud_builder.h>

#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using PntsTest = InputTest;

std::string pnts(const std::string& features, const std::string& bytes, const std::string& batches = "",
                 const std::string& batch_bytes = "") {
    const auto size = [](const std::string& part) { return bytesOf(std::uint32_t(part.size())); };
    const std::string tables = features + bytes + batches + batch_bytes;
    return "pnts" + bytesOf(1u) + bytesOf(std::uint32_t(28 + tables.size())) + size(features) + size(bytes) +
           size(batches) + size(batch_bytes) + tables;
}

template <typename Value>
std::string pntsValues(const std::vector<Value>& list) {
    std::string bytes;
    for (const Value value : list) bytes += bytesOf(value);
    return bytes;
}

const std::string kPlain = pnts(
    "{\"POINTS_LENGTH\":2,\"RTC_CENTER\":[6371000,0,0],\"POSITION\":{\"byteOffset\":0},\"RGB\":{\"byteOffset\":24},"
    "\"NORMAL_OCT16P\":{\"byteOffset\":30}}",
    pntsValues<float>({1, 2, 3, 4, 5, 6}) + "\x01\x02\x03\x04\x05\xff\xff\x80\x80\xff",
    "{\"intensity\":{\"byteOffset\":0,\"componentType\":\"UNSIGNED_SHORT\",\"type\":\"SCALAR\"}}",
    pntsValues<std::uint16_t>({7, 9}));

TEST_F(PntsTest, PositionsAroundACentreOnTheEarth) {
    const Cloud cloud = readText("a.pnts", kPlain);
    ASSERT_EQ(cloud.positions.size(), 2u);
    EXPECT_EQ(world(cloud, 1), Vec3d(6371004, 5, 6));
    EXPECT_EQ(cloud.colors.at(1), (Rgb8{4, 5, 255}));
    EXPECT_NEAR(cloud.normals.at(0).x(), 1, 1e-2); // 128 of 255 is not quite the middle
    EXPECT_NEAR(cloud.normals.at(1).y(), 1, 1e-2);
    EXPECT_EQ(numbersOf(cloud, "intensity"), (Numbers{7, 9}));
    EXPECT_NEAR(cloud.world.up.x(), 1, 1e-9);
    EXPECT_EQ(cloud.world.metres_per_unit, 1);
}

TEST_F(PntsTest, QuantisedPositionsAndColours) {
    const Cloud cloud = readText(
        "a.pnts", pnts("{\"POINTS_LENGTH\":2,\"POSITION_QUANTIZED\":{\"byteOffset\":0},\"RGB565\":{\"byteOffset\":12},"
                       "\"QUANTIZED_VOLUME_OFFSET\":[10,20,30],\"QUANTIZED_VOLUME_SCALE\":[1,2,4]}",
                       pntsValues<std::uint16_t>({0, 0, 0, 65535, 65535, 65535, 31 << 11, 63 << 5})));
    EXPECT_EQ(world(cloud, 0), Vec3d(10, 20, 30));
    EXPECT_EQ(world(cloud, 1), Vec3d(11, 22, 34));
    EXPECT_EQ(cloud.colors.at(0), (Rgb8{255, 0, 0}));
    EXPECT_EQ(cloud.colors.at(1), (Rgb8{0, 255, 0}));
}

/// Two points, whose colours are a generic attribute.
std::string dracoPoints() {
    draco::PointCloudBuilder builder;
    builder.Start(2);
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int color = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 3, draco::DT_UINT8);
    const float positions[] = {1, 2, 3, 4, 5, 6};
    const std::uint8_t colors[] = {1, 2, 3, 4, 5, 255};
    builder.SetAttributeValuesForAllPoints(position, positions, 0);
    builder.SetAttributeValuesForAllPoints(color, colors, 0);
    const auto cloud = builder.Finalize(false);
    draco::PointCloudSequentialEncoder encoder;
    draco::EncoderBuffer buffer;
    encoder.SetPointCloud(*cloud);
    encoder.Encode(draco::EncoderOptions::CreateDefaultOptions(), &buffer);
    return {buffer.data(), buffer.size()};
}

TEST_F(PntsTest, DracoCompression) {
    const std::string packed = dracoPoints();
    const Cloud cloud = readText(
        "a.pnts",
        pnts(fmt::format(
                 "{{\"POINTS_LENGTH\":2,\"RTC_CENTER\":[100,0,0],\"POSITION\":{{\"byteOffset\":0}},\"extensions\":"
                 "{{\"3DTILES_draco_point_compression\":{{\"properties\":{{\"POSITION\":0,\"RGB\":1}},"
                 "\"byteOffset\":0,\"byteLength\":{}}}}}}}",
                 packed.size()),
             packed));
    ASSERT_EQ(cloud.positions.size(), 2u);
    EXPECT_EQ(world(cloud, 1), Vec3d(104, 5, 6));
    EXPECT_EQ(cloud.colors.at(1), (Rgb8{4, 5, 255}));
    EXPECT_TRUE(cloud.attributes.empty());
}

TEST_F(PntsTest, TablesThatLieOutsideAreRefused) {
    EXPECT_HAS(
        reasonOfText("a.pnts", pnts("{\"POINTS_LENGTH\":4000000000,\"POSITION\":{\"byteOffset\":0}}", "12345678")),
        "POSITION");
    EXPECT_HAS(reasonOfText("b.pnts", pnts("{\"POINTS_LENGTH\":1}", "")), "POSITION_QUANTIZED");
    EXPECT_HAS(reasonOfText("c.pnts", kPlain.substr(0, kPlain.size() - 1)), "truncated");
}

TEST_F(PntsTest, DamagedFilesAreReadOrRefused) {
    readPrefixes("a.pnts", kPlain);
    readChangedBytes("a.pnts", kPlain);
}

} // namespace
} // namespace pointrt
