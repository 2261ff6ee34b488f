// SPDX-License-Identifier: Apache-2.0
// 350 points made from a tile of 10 x 10: their places, and that runs are reproducible.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>

#include "format/pointio/las_writer.h"
#include "tests/format/file_bytes.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

constexpr int kStep = 100, kSide = 10, kSize = kStep * (kSide - 1) + 1; // raw numbers
constexpr std::size_t kRecordBytes = 26;                                // of point format 2
using Raw = std::array<std::int32_t, 3>;

Raw tilePoint(int i) { return {5000 + i % kSide * kStep, -3000 + i / kSide * kStep, 700}; }

void writeTile(const std::string& path) {
    LasDescription description;
    description.header.point_format = 2;
    description.header.record_bytes = kRecordBytes;
    description.header.point_count = kSide * kSide;
    description.header.scale = {0.01, 0.01, 0.01};
    test::Bytes bytes;
    const auto put = [&](std::uint64_t at, const void* data, std::size_t size) {
        bytes.resize(std::max<std::size_t>(bytes.size(), at + size));
        std::memcpy(bytes.data() + at, data, size);
        return true;
    };
    LasWriter writer(description,
                     {[&](const void* data, std::size_t size) { return put(bytes.size(), data, size); }, put});
    for (int i = 0; i < kSide * kSide; ++i) {
        std::array<char, kRecordBytes> record{};
        const Raw point = tilePoint(i);
        std::memcpy(record.data(), point.data(), sizeof point);
        record[12] = static_cast<char>(i); // intensity
        ASSERT_TRUE(writer.add(record.data(), 1));
    }
    ASSERT_TRUE(writer.finish());
    test::writeBytes(path, bytes);
}

struct MakeLidar : testing::Test {
    test::TemporaryFolder folder;

    void SetUp() override { writeTile(folder.file("tile.las")); }

    void run(const std::string& arguments) {
        const std::string command = std::string(POINTRT_MAKE_LIDAR) + " " + folder.file("tile.las") + " " + arguments;
        ASSERT_EQ(std::system(command.c_str()), 0) << command;
    }

    /// The records of all files, in order.
    std::vector<test::Bytes> records(const std::string& name) {
        std::vector<test::Bytes> all;
        for (const char* file : {"scan_0000.las", "scan_0001.las", "scan_0002.las", "scan_0003.las"}) {
            const std::string path = folder.file(name) + "/" + file;
            if (!std::filesystem::exists(path)) continue;
            const test::Bytes bytes = test::readBytes(path);
            for (std::size_t at = test::loadAt(bytes, 96); at < bytes.size(); at += kRecordBytes)
                all.emplace_back(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                                 bytes.begin() + static_cast<std::ptrdiff_t>(at + kRecordBytes));
        }
        return all;
    }
};

TEST_F(MakeLidar, LaysCopiesOutAsMirrorImages) {
    run("350 " + folder.file("a") + " --las --per-file 100");
    const auto points = records("a");
    ASSERT_EQ(points.size(), 350u);
    std::set<Raw> different;
    constexpr std::array<std::array<int, 2>, 4> kCells = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}; // there and back
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Raw is = test::loadAt<Raw>(points[i], 0), in_tile = tilePoint(static_cast<int>(i % 100));
        EXPECT_EQ(std::to_integer<std::size_t>(points[i][12]), i % 100) << "other fields are unchanged";
        const auto cell = kCells[i / 100];
        const std::array<int, 2> inside = {in_tile[0] - 5000, in_tile[1] + 3000};
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const int mirrored = cell[axis] == 0 ? inside[axis] : 2 * kSize - 1 - inside[axis];
            EXPECT_NEAR(is[axis], mirrored, 15) << i; // a sixth of the spacing
        }
        EXPECT_LT(std::abs(is[2] - 700), 60) << "long waves";
        different.insert(is);
    }
    EXPECT_EQ(different.size(), 350u);
}

TEST_F(MakeLidar, BytesDependOnTheSeedAndNotOnParts) {
    run("350 " + folder.file("a") + " --las --per-file 100");
    run("350 " + folder.file("b") + " --las --per-file 100 --first 2");
    run("350 " + folder.file("b") + " --las --per-file 100 --first 0 --files 2");
    EXPECT_EQ(records("a"), records("b"));
    run("350 " + folder.file("c") + " --las --per-file 100 --seed 2");
    EXPECT_NE(records("a"), records("c"));
}

} // namespace
} // namespace pointrt
