// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/input_fixture.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <draco/point_cloud/point_cloud_builder.h>

namespace pointrt {
namespace {

using DracoTest = InputTest;
using draco::GeometryAttribute;

std::string encodedPoints(int method) {
    draco::PointCloudBuilder builder;
    builder.Start(3);
    const int position = builder.AddAttribute(GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int normal = builder.AddAttribute(GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
    const int color = builder.AddAttribute(GeometryAttribute::COLOR, 4, draco::DT_UINT8);
    for (int i = 0; i < 3; ++i) {
        const float p[] = {static_cast<float>(i), 0.5f, -2.f * static_cast<float>(i)}, n[] = {0, 0, 1};
        const std::uint8_t rgba[] = {static_cast<std::uint8_t>(i), 20, 30, 255};
        builder.SetAttributeValueForPoint(position, draco::PointIndex(i), p);
        builder.SetAttributeValueForPoint(normal, draco::PointIndex(i), n);
        builder.SetAttributeValueForPoint(color, draco::PointIndex(i), rgba);
    }
    const auto points = builder.Finalize(false);
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodePointCloudToBuffer(*points, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

/// bits: of each coordinate, delta-coded; 0: unquantised floats
std::string encodedMesh(int method, int bits = 0) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position = builder.AddAttribute(GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const float a[] = {0, 0, 0}, b[] = {1, 0, 0}, c[] = {1, 1, 0}, d[] = {0, 1, 0};
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(0), a, b, c);
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(1), a, c, d);
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetEncodingMethod(method);
    if (bits > 0) {
        encoder.SetAttributeQuantization(GeometryAttribute::POSITION, bits);
        encoder.SetAttributePredictionScheme(GeometryAttribute::POSITION, draco::PREDICTION_DIFFERENCE);
    }
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

TEST_F(DracoTest, Points) {
    const Cloud cloud = readText("a.drc", encodedPoints(draco::POINT_CLOUD_SEQUENTIAL_ENCODING));
    ASSERT_EQ(cloud.positions.size(), 3u);
    EXPECT_EQ(world(cloud, 2), Vec3d(2, 0.5, -4));
    EXPECT_EQ(cloud.normals[1], Vec3f(0, 0, 1));
    EXPECT_EQ(cloud.colors[2], (Rgb8{2, 20, 30}));
}

TEST_F(DracoTest, Meshes) {
    for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const Cloud cloud = readText("a.drc", encodedMesh(method));
        EXPECT_EQ(cloud.positions.size(), 4u);
        EXPECT_EQ(cloud.triangles.size(), 2u);
        EXPECT_EQ(cloud.normals[0], Vec3f(0, 0, 1));
    }
}

TEST_F(DracoTest, OtherAttributesAreKept) {
    draco::PointCloudBuilder builder;
    builder.Start(2);
    const int position = builder.AddAttribute(GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int color = builder.AddAttribute(GeometryAttribute::COLOR, 3, draco::DT_UINT16);
    const int time = builder.AddAttribute(GeometryAttribute::GENERIC, 1, draco::DT_FLOAT64);
    const int tags = builder.AddAttribute(GeometryAttribute::GENERIC, 2, draco::DT_INT16);
    for (int i = 0; i < 2; ++i) {
        const float p[] = {static_cast<float>(i), 0.5f, 2};
        const std::uint16_t rgb[] = {static_cast<std::uint16_t>(i), 300, 65535};
        const double seconds = 413665.23368423499 + i;
        const short pair[] = {static_cast<short>(-i), 300};
        builder.SetAttributeValueForPoint(position, draco::PointIndex(i), p);
        builder.SetAttributeValueForPoint(color, draco::PointIndex(i), rgb);
        builder.SetAttributeValueForPoint(time, draco::PointIndex(i), &seconds);
        builder.SetAttributeValueForPoint(tags, draco::PointIndex(i), pair);
    }
    const auto points = builder.Finalize(false);
    auto metadata = std::make_unique<draco::AttributeMetadata>();
    metadata->AddEntryString("name", "GpsTime");
    points->AddAttributeMetadata(time, std::move(metadata));
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::POINT_CLOUD_SEQUENTIAL_ENCODING);
    draco::EncoderBuffer buffer;
    ASSERT_TRUE(encoder.EncodePointCloudToBuffer(*points, &buffer).ok());
    const Cloud cloud = readText("a.drc", {buffer.data(), buffer.size()});
    const std::string unnamed = fmt::format("generic_{}", points->attribute(tags)->unique_id());
    EXPECT_EQ(attributeNames(cloud), (Names{"rgb16", "gps_time", unnamed}));
    EXPECT_EQ(numbersOf(cloud, "rgb16"), (Numbers{0, 300, 65535, 1, 300, 65535}));
    EXPECT_EQ(cloud.colors[1], (Rgb8{0, 1, 255}));
    EXPECT_EQ(numbersOf(cloud, "gps_time"), (Numbers{413665.23368423499, 413666.23368423499}));
    EXPECT_EQ(numbersOf(cloud, unnamed), (Numbers{0, 300, -1, 300}));
}

TEST_F(DracoTest, EveryPrefixIsRefusedCleanly) {
    readPrefixes("a.drc", encodedPoints(draco::POINT_CLOUD_SEQUENTIAL_ENCODING));
    readPrefixes("b.drc", encodedMesh(draco::MESH_SEQUENTIAL_ENCODING));
    readPrefixes("c.drc", encodedMesh(draco::MESH_EDGEBREAKER_ENCODING));
}

TEST_F(DracoTest, UnknownPredictionMethodsAreRefused) {
    for (const int encoding : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
        const std::string mesh = encodedMesh(encoding, 8);
        // The decoder of quantised numbers, the prediction method, the wrap transform
        const std::size_t method = mesh.find(std::string("\2\0\1", 3)) + 1;
        ASSERT_NE(method, 0u);
        EXPECT_EQ(readText("a.drc", mesh).positions.size(), 4u);
        for (const char none : {'\x07', '\x64', '\x80', '\xfd'}) {
            std::string broken = mesh;
            broken[method] = none;
            EXPECT_HAS(reasonOfText("b.drc", broken), "Draco data *invalid");
        }
    }
}

TEST_F(DracoTest, TreesOfPoints) {
    draco::PointCloudBuilder builder;
    builder.Start(20);
    const int position = builder.AddAttribute(GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (int i = 0; i < 20; ++i) {
        const float p[] = {static_cast<float>(i), static_cast<float>(i % 7), 2};
        builder.SetAttributeValueForPoint(position, draco::PointIndex(i), p);
    }
    draco::Encoder encoder;
    encoder.SetEncodingMethod(draco::POINT_CLOUD_KD_TREE_ENCODING);
    encoder.SetAttributeQuantization(GeometryAttribute::POSITION, 12);
    draco::EncoderBuffer buffer;
    ASSERT_TRUE(encoder.EncodePointCloudToBuffer(*builder.Finalize(false), &buffer).ok());
    const std::string bytes(buffer.data(), buffer.size());
    EXPECT_EQ(bytes[8], '\1') << "not a tree";
    EXPECT_EQ(readText("a.drc", bytes).positions.size(), 20u);
    readPrefixes("b.drc", bytes);
}

TEST_F(DracoTest, OldTreesHaveAsManyPointsAsTheirHeader) {
    const std::string header = std::string("DRACO\2\2\0\1\0\0", 11) + bytesOf(65534);
    const std::string position = std::string("\1\1\0\x09\3\0\0", 7); // one decoder, one attribute: three floats
    const std::string method_and_level(2, '\0');
    for (const int points : {0, 0x73000000, 65535}) {
        const std::string reason =
            reasonOfText("a.drc", header + position + method_and_level + bytesOf(points) + "\4\1");
        EXPECT_HAS(reason, "Draco data *truncated");
        EXPECT_EQ(reason.find("impossible sizes"), std::string::npos) << "memory was requested: " << reason;
    }
}

TEST_F(DracoTest, CountsAreCheckedBeforeAllocation) {
    // The number of points follows the header of 11 bytes.
    std::string points = encodedPoints(draco::POINT_CLOUD_SEQUENTIAL_ENCODING);
    points.replace(11, 4, bytesOf(0x7fffffff));
    EXPECT_HAS(reasonOfText("a.drc", points), "promises 2147483647 points");
    EXPECT_HAS(reasonOfText("b.drc", "DRACO"), "b.drc: *header");
    EXPECT_HAS(reasonOfText("c.drc", "DRACO garbage that is none at all, and more of it"), "c.drc: the ");
}

} // namespace
} // namespace pointrt
