// SPDX-License-Identifier: Apache-2.0
// Recordings of ROS: clouds in bags and MCAP files.
#include <lz4frame.h>
#include <zstd.h>

#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using RosTest = InputTest;

std::string sized(const std::string& text) { return bytesOf(std::uint32_t(text.size())) + text; }

/// A message of one point with an intensity. CDR ends texts with a 0 and aligns numbers to 4 bytes.
std::string message(bool cdr, const std::string& frame, float x, std::uint32_t width = 1) {
    std::string bytes = cdr ? "" : bytesOf(1u); // seq
    bytes += bytesOf(5u) + bytesOf(6u);         // stamp
    const auto put = [&](const std::string& text) {
        bytes += cdr ? sized(text + std::string(1, '\0')) : sized(text);
        while (cdr && bytes.size() % 4 != 0) bytes += '\0';
    };
    put(frame);
    bytes += bytesOf(1u) + bytesOf(width) + bytesOf(4u); // height, width, fields
    std::uint32_t offset = 0;
    for (const char* const name : {"x", "y", "z", "intensity"}) {
        put(name);
        bytes += bytesOf(offset) + '\7'; // float
        while (cdr && bytes.size() % 4 != 0) bytes += '\0';
        bytes += bytesOf(1u);
        offset += 4;
    }
    bytes += '\0'; // little-endian
    while (cdr && bytes.size() % 4 != 0) bytes += '\0';
    bytes += bytesOf(16u) + bytesOf(16 * width) + bytesOf(16u);
    bytes += bytesOf(x) + bytesOf(2.f) + bytesOf(3.f) + bytesOf(0.5f) + '\1';
    return (cdr ? std::string("\0\1\0\0", 4) : "") + bytes;
}

std::string mcapRecord(char kind, const std::string& content) {
    return kind + bytesOf(std::uint64_t(content.size())) + content;
}

/// Schema, channel and messages with x from 1.
std::string mcapRecords(int messages, const std::string& frame = "lidar") {
    const std::string schema =
        bytesOf(std::uint16_t{1}) + sized("sensor_msgs/msg/PointCloud2") + sized("ros2msg") + sized("");
    const std::string channel =
        bytesOf(std::uint16_t{7}) + bytesOf(std::uint16_t{1}) + sized("/points") + sized("cdr") + sized("");
    std::string bytes = mcapRecord(3, schema) + mcapRecord(4, channel);
    for (int i = 1; i <= messages; ++i)
        bytes += mcapRecord(5, bytesOf(std::uint16_t{7}) + std::string(20, '\0') + message(true, frame, float(i)));
    return bytes;
}

std::string mcap(const std::string& records) {
    const std::string mark = "\x89MCAP0\r\n";
    return mark + mcapRecord(1, sized("ros2") + sized("test")) + records + mcapRecord(15, bytesOf(0u)) + mark;
}

std::string mcapChunk(const std::string& records, const std::string& compression, const std::string& packed) {
    return mcapRecord(6, std::string(16, '\0') + bytesOf(std::uint64_t(records.size())) + bytesOf(0u) +
                             sized(compression) + bytesOf(std::uint64_t(packed.size())) + packed);
}

std::string lz4(const std::string& bytes) {
    std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
    packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
    return packed;
}

std::string zstd(const std::string& bytes) {
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1));
    return packed;
}

std::string bagRecord(const std::vector<std::string>& fields, const std::string& data) {
    std::string header;
    for (const std::string& field : fields) header += sized(field);
    return sized(header) + sized(data);
}

std::string bagRecords(float x) {
    const std::string connection = "conn=" + bytesOf(0u);
    return bagRecord({"op=\7", connection, "topic=/velodyne"}, sized("type=sensor_msgs/PointCloud2")) +
           bagRecord({"op=\2", connection, "time=12345678"}, message(false, "lidar", x));
}

std::string bag(const std::string& compression, const std::string& records, const std::string& packed) {
    return "#ROSBAG V2.0\n" + bagRecord({"op=\3"}, "    ") +
           bagRecord({"op=\5", "compression=" + compression, "size=" + bytesOf(std::uint32_t(records.size()))}, packed);
}

void expectClouds(const Cloud& cloud, std::size_t clouds) {
    ASSERT_EQ(cloud.positions.size(), clouds);
    ASSERT_EQ(cloud.scans.size(), clouds);
    for (std::size_t i = 0; i < clouds; ++i) EXPECT_EQ(world(cloud, i), Vec3d(double(i + 1), 2, 3));
    EXPECT_EQ(numbersOf(cloud, "intensity"), Numbers(clouds, 0.5));
    EXPECT_EQ(cloud.world.up, Vec3d(0, 0, 1));
}

TEST_F(RosTest, McapWithAndWithoutChunks) {
    const std::string records = mcapRecords(2);
    const Cloud cloud = readText("a.mcap", mcap(records));
    expectClouds(cloud, 2);
    EXPECT_EQ(*cloud.scans[1].sensor, Vec3d(0, 0, 0));
    EXPECT_HAS(notesOf(cloud), "/points (2 in frame lidar)");
    expectClouds(readText("b.mcap", mcap(mcapChunk(records, "", records))), 2);
    expectClouds(readText("c.mcap", mcap(mcapChunk(records, "lz4", lz4(records)))), 2);
    expectClouds(readText("d.mcap", mcap(mcapChunk(records, "zstd", zstd(records)))), 2);
}

TEST_F(RosTest, BagsWithAndWithoutCompression) {
    const std::string records = bagRecords(1);
    expectClouds(readText("a.bag", bag("none", records, records)), 1);
    expectClouds(readText("b.bag", bag("lz4", records, lz4(records))), 1);
    EXPECT_HAS(reasonOfText("c.bag", bag("bz2", records, records)), "bz2");
}

TEST_F(RosTest, MapsHaveNoScannerAtTheirOrigin) {
    EXPECT_FALSE(readText("a.mcap", mcap(mcapRecords(1, "Odom"))).scans[0].sensor.has_value());
}

TEST_F(RosTest, RecordingsWithoutCloudsNameTheirTopics) {
    std::string records = mcapRecords(0);
    records.replace(records.find("PointCloud2"), 11, "LaserScan!!");
    EXPECT_HAS(reasonOfText("a.mcap", mcap(records)), "/points");
}

TEST_F(RosTest, CloudsThatPromiseTooMuchAreRefused) {
    const std::string data = bytesOf(std::uint16_t{7}) + std::string(20, '\0') + message(true, "lidar", 1, 1000);
    EXPECT_HAS(reasonOfText("a.mcap", mcap(mcapRecords(0) + mcapRecord(5, data))), "1 x 1000");
    EXPECT_HAS(reasonOfText("b.mcap", mcap(mcapChunk(std::string(1 << 27, ' '), "zstd", "x"))), "134217728");
}

TEST_F(RosTest, SalvagesCloudsBeforeTheEnd) {
    const std::string whole = mcap(mcapRecords(2));
    const std::string path = write("a.mcap", whole.substr(0, whole.size() - 60));
    EXPECT_HAS(reasonOf(path), "--salvage");
    ReadOptions options;
    options.salvages = true;
    expectClouds(read(path, options), 1);
}

TEST_F(RosTest, DamagedFilesAreReadOrRefused) {
    const std::string records = mcapRecords(1), small = bagRecords(1);
    readChangedBytes("a.mcap", mcap(records));
    readChangedBytes("b.mcap", mcap(mcapChunk(records, "lz4", lz4(records))));
    readChangedBytes("a.bag", bag("none", small, small));
    readPrefixes("b.bag", bag("lz4", small, lz4(small)));
}

} // namespace
} // namespace pointrt
