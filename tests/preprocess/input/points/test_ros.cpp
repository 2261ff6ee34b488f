// SPDX-License-Identifier: Apache-2.0
// Recordings of ROS: clouds in bags and MCAP files, placed by their poses.
#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using RosTest = InputTest;

std::string sized(const std::string& text) { return bytesOf(std::uint32_t(text.size())) + text; }

/// Assembles a message from its members. CDR ends texts with a 0 and aligns numbers to their size.
struct RosBytes {
    bool cdr;
    std::string bytes = {};

    template <typename Value>
    RosBytes& put(Value value) {
        while (cdr && bytes.size() % sizeof value != 0) bytes += '\0';
        bytes += bytesOf(value);
        return *this;
    }
    RosBytes& text(const std::string& text) {
        put(std::uint32_t(text.size() + cdr));
        bytes += cdr ? text + std::string(1, '\0') : text;
        return *this;
    }
    RosBytes& header(std::uint32_t seconds, const std::string& frame) {
        if (!cdr) put(1u); // seq
        return put(seconds).put(0u).text(frame);
    }
    std::string whole() const { return (cdr ? std::string("\0\1\0\0", 4) : "") + bytes; }
};

/// A message of one point with an intensity.
std::string message(bool cdr, const std::string& frame, float x, std::uint32_t width = 1, std::uint32_t seconds = 5) {
    RosBytes message{cdr};
    message.header(seconds, frame).put(1u).put(width).put(4u); // height, width, fields
    std::uint32_t offset = 0;
    for (const char* const name : {"x", "y", "z", "intensity"}) {
        message.text(name).put(offset).put('\7').put(1u); // float
        offset += 4;
    }
    message.put('\0').put(16u).put(16 * width).put(16u); // little-endian
    message.put(x).put(2.f).put(3.f).put(0.5f).put('\1');
    return message.whole();
}

/// A pose of a frame: along x, turned about z.
struct RosPose {
    std::uint32_t seconds;
    std::string parent, frame;
    double x = 0, turn_deg = 0, z = 0;
};

void putPose(RosBytes& message, const RosPose& where) {
    const double half = where.turn_deg * M_PI / 360;
    for (const double value : {where.x, 0.0, where.z, 0.0, 0.0, std::sin(half), std::cos(half)}) message.put(value);
}

std::string transforms(bool cdr, const std::vector<RosPose>& list) {
    RosBytes message{cdr};
    message.put(std::uint32_t(list.size()));
    for (const RosPose& each : list) {
        message.header(each.seconds, each.parent).text(each.frame);
        putPose(message, each);
    }
    return message.whole();
}

std::string odometry(bool cdr, const RosPose& where) {
    RosBytes message{cdr};
    message.header(where.seconds, where.parent).text(where.frame);
    putPose(message, where);
    return message.whole() + std::string(36 * 8, '\0'); // covariance
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

std::string bzip2(const std::string& bytes) {
    auto size = static_cast<unsigned>(bytes.size() + 1000);
    std::string packed(size, '\0');
    BZ2_bzBuffToBuffCompress(packed.data(), &size, const_cast<char*>(bytes.data()), unsigned(bytes.size()), 9, 0, 0);
    packed.resize(size);
    return packed;
}

/// A bag of messages, each with its topic.
struct RosTopic {
    std::string name, type;
};
const RosTopic kLidarTopic{"/velodyne", "sensor_msgs/PointCloud2"}, kTfTopic{"/tf", "tf2_msgs/TFMessage"},
    kStaticTopic{"/tf_static", "tf2_msgs/TFMessage"}, kOdometryTopic{"/odom", "nav_msgs/Odometry"};

std::string bagOf(const std::vector<std::pair<RosTopic, std::string>>& messages) {
    std::string bytes = "#ROSBAG V2.0\n" + bagRecord({"op=\3"}, "    ");
    for (const auto& [topic, data] : messages) {
        // the byte keeps names different
        const std::string connection = "conn=" + bytesOf(std::uint32_t(topic.name.size()));
        bytes += bagRecord({"op=\7", connection, "topic=" + topic.name}, sized("type=" + topic.type));
        bytes += bagRecord({"op=\2", connection, "time=12345678"}, data);
    }
    return bytes;
}

std::string cloudAt(std::uint32_t seconds, const std::string& frame = "lidar") {
    return message(false, frame, 1, 1, seconds);
}

std::string transforms(const std::vector<RosPose>& list) { return transforms(false, list); }

void expectNear(const Vec3d& position, const Vec3d& expected) {
    EXPECT_LT((position - expected).norm(), 1e-6) << position.transpose() << ", not " << expected.transpose();
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
    expectClouds(readText("c.bag", bag("bz2", records, bzip2(records))), 1);
    EXPECT_HAS(reasonOfText("d.bag", bag("bz2", records, records)), "bz2");
    EXPECT_HAS(reasonOfText("e.bag", bag("xz", records, records)), "xz");
}

TEST_F(RosTest, TransformsPlaceCloudsAtTheirTimes) {
    // The cloud of second 5 comes before the poses around it; that of second 90 has none.
    const Cloud cloud = readText("a.bag", bagOf({{kLidarTopic, cloudAt(5)},
                                                 {kLidarTopic, cloudAt(90)},
                                                 {kStaticTopic, transforms({{1, "/base_link", "lidar", 0, 0, 1}})},
                                                 {kTfTopic, transforms({{4, "odom", "base_link"}})},
                                                 {kTfTopic, transforms({{6, "odom", "base_link", 20, 90}})}}));
    ASSERT_EQ(cloud.positions.size(), 1u);
    const double half = std::sqrt(0.5); // turned by 45 degrees: (1, 2) becomes (1 - 2, 1 + 2) * half
    expectNear(world(cloud, 0), {10 - half, 3 * half, 4});
    expectNear(*cloud.scans[0].sensor, {10, 0, 1});
    EXPECT_HAS(notesOf(cloud), "placed in frame 'odom'");
    EXPECT_HAS(notesOf(cloud), "1 of 2 clouds");
}

TEST_F(RosTest, McapPosesPlaceClouds) {
    const auto schema = [](std::uint16_t id, const std::string& type) {
        return mcapRecord(3, bytesOf(id) + sized(type) + sized("ros2msg") + sized("")) +
               mcapRecord(4, bytesOf(id) + bytesOf(id) + sized("/topic") + sized("cdr") + sized(""));
    };
    const auto record = [](std::uint16_t channel, const std::string& data) {
        return mcapRecord(5, bytesOf(channel) + std::string(20, '\0') + data);
    };
    const std::string poses =
        schema(20, "tf2_msgs/msg/TFMessage") +
        record(20,
               transforms(true, {{4, "map", "odom", 100}, {6, "map", "odom", 100}, {1, "base", "lidar", 0, 0, 1}})) +
        schema(21, "nav_msgs/msg/Odometry") + record(21, odometry(true, {4, "odom", "base"})) +
        record(21, odometry(true, {6, "odom", "base", 2}));
    const Cloud cloud = readText("a.mcap", mcap(mcapRecords(1) + poses));
    ASSERT_EQ(cloud.positions.size(), 1u);
    expectNear(world(cloud, 0), {102, 2, 4});
    EXPECT_HAS(notesOf(cloud), "placed in frame 'map'");
}

TEST_F(RosTest, OdometryMovesWhatTransformsOnlyMount) {
    const Cloud cloud = readText(
        "a.bag", bagOf({{kStaticTopic, transforms({{1, "base", "lidar", 0, 0, 1}, {1, "footprint", "base", 0, 0, 5}})},
                        {kOdometryTopic, odometry(false, {4, "odom", "base"})},
                        {kOdometryTopic, odometry(false, {6, "odom", "base", 2})},
                        {kLidarTopic, cloudAt(5)}}));
    expectNear(world(cloud, 0), {2, 2, 4});
    const Cloud mounted = readText(
        "b.bag", bagOf({{kLidarTopic, cloudAt(5)}, {kStaticTopic, transforms({{1, "base", "lidar", 0, 0, 1}})}}));
    expectNear(world(mounted, 0), {1, 2, 4});
    EXPECT_HAS(notesOf(mounted), "static transforms");
}

TEST_F(RosTest, CloudsWithoutAPoseStayAsTheyAre) {
    const std::vector<RosPose> elsewhere{{4, "odom", "camera"}, {6, "odom", "camera", 20}};
    for (const std::vector<RosPose>& list :
         {elsewhere,                                                                    // another frame
          std::vector<RosPose>{{44, "odom", "lidar"}, {46, "odom", "lidar", 20}},       // another clock
          std::vector<RosPose>{{4, "b", "lidar", 1}, {4, "lidar", "b", 1}},             // a cycle
          std::vector<RosPose>{{4, "lidar", "lidar", 1}, {4, "odom", "lidar", NAN}}}) { // no poses
        const Cloud cloud = readText("a.bag", bagOf({{kTfTopic, transforms(list)}, {kLidarTopic, cloudAt(5)}}));
        EXPECT_EQ(world(cloud, 0), Vec3d(1, 2, 3));
        EXPECT_HAS(notesOf(cloud), "without poses");
    }
}

TEST_F(RosTest, TheIndexTellsWhetherThereArePoses) {
    const std::string tf = transforms({{4, "odom", "lidar"}, {6, "odom", "lidar", 20}});
    const std::string records = bagOf({{kTfTopic, tf}, {kLidarTopic, cloudAt(5)}});
    const auto indexed = [&](const std::string& type) {
        std::string bytes = records;
        const std::string header = "index_pos=" + bytesOf(std::uint64_t(records.size() + 22));
        bytes.replace(13, bagRecord({"op=\3"}, "    ").size(), bagRecord({"op=\3", header}, "    "));
        return bytes + bagRecord({"op=\7", "conn=" + bytesOf(0u), "topic=/any"}, sized("type=" + type));
    };
    expectNear(world(readText("a.bag", indexed(kTfTopic.type)), 0), {11, 2, 3});
    expectNear(world(readText("b.bag", indexed(kLidarTopic.type)), 0), {1, 2, 3}); // the index is trusted
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
    readChangedBytes("c.bag", bagOf({{kTfTopic, transforms({{5, "odom", "lidar", 1}})}, {kLidarTopic, cloudAt(5)}}));
    readPrefixes("b.bag", bag("lz4", small, lz4(small)));
}

} // namespace
} // namespace pointrt
