// SPDX-License-Identifier: Apache-2.0
// Compressed points: round trips of every format, all kinds of chunks, and malformed data.
#include "format/pointio/laz.h"

#include <gtest/gtest.h>

#include <random>

#include "format/base/error.h"
#include "format/pointio/rust_abi.h"
#include "tests/support/las_file.h"
#include "tests/support/packed_las.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

using test::put;
using test::writeLas;

/// A random walk with occasionally changing bytes, like points of scans.
std::vector<std::string> wanderingPoints(std::size_t bytes, std::size_t count) {
    std::mt19937 random(7);
    std::vector<std::string> points;
    std::string point = test::lasPoint(bytes, 1000, -2000, 300, 1);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::int32_t whole;
            std::memcpy(&whole, point.data() + 4 * axis, sizeof whole);
            put(point, 4 * axis, whole + static_cast<std::int32_t>(random() % 201) - 100);
        }
        point[12 + random() % (bytes - 12)] = static_cast<char>(random());
        points.push_back(point);
    }
    return points;
}

std::string joined(const std::vector<std::string>& points) {
    std::string all;
    for (const std::string& point : points) all += point;
    return all;
}

/// All records of a compressed file.
std::string unpacked(const std::string& bytes) {
    const LasFile file = openLas(bytes);
    const LazLayout layout = lazLayout(file);
    std::string all;
    for (const LazChunk& chunk : layout.chunks) {
        LazStream stream(layout, bytes, chunk);
        constexpr std::uint64_t kAtOnce = 4096;
        for (std::uint64_t done = 0; done < chunk.points; done += kAtOnce) {
            const std::uint64_t now = std::min(kAtOnce, chunk.points - done);
            std::string records(now * file.header.record_bytes, '\0');
            stream.read(records.data(), now);
            all += records;
        }
    }
    return all;
}

struct LazTest : testing::Test {
    void SetUp() override {
        if (!hasLaz()) GTEST_SKIP() << "this build has no LAZ";
    }
};

TEST_F(LazTest, EveryFormatRoundTrips) {
    for (std::uint8_t format = 0; format <= 10; ++format)
        for (const std::size_t extra : {0, 1, 7}) {
            const auto points = wanderingPoints(lasRecordBytes(format) + extra, 3000);
            const std::string bytes = writeLas(format, points, true);
            EXPECT_EQ(unpacked(bytes), joined(points)) << int{format} << " with " << extra;
            EXPECT_LT(bytes.size(), 3000u * lasRecordBytes(format));
        }
}

TEST_F(LazTest, PointsOfManyChunksAreInOrder) {
    const auto points = wanderingPoints(20, 50001);
    const std::string bytes = writeLas(0, points, true);
    EXPECT_EQ(lazLayout(openLas(bytes)).chunks.size(), 2u);
    EXPECT_EQ(unpacked(bytes), joined(points));
}

/// A file with chunks of variable size, as in COPC: compressed one by one, with a handmade table.
std::string variableChunks(std::uint8_t format, const std::vector<std::vector<std::string>>& chunks) {
    std::vector<std::string> all;
    for (const auto& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
    std::string bytes = writeLas(format, all, true);
    const LasFile file = openLas(bytes);
    std::string record(findVlr(file, kLaszipUser, kLaszipRecord)->data);
    const std::size_t record_at = bytes.find(record);
    put(record, 12, ~std::uint32_t{0});
    bytes.replace(record_at, record.size(), record);
    bytes.resize(file.header.point_offset + 8);
    std::vector<std::uint64_t> counts, sizes;
    for (const auto& chunk : chunks) {
        const std::string packed = packChunk(record, joined(chunk));
        bytes += packed;
        counts.push_back(chunk.size());
        sizes.push_back(packed.size());
    }
    put(bytes, file.header.point_offset, std::int64_t(bytes.size()));
    return bytes + packTable(record, counts, sizes);
}

TEST_F(LazTest, ChunksOfAnySize) {
    for (const std::uint8_t format : {3, 7}) {
        const auto points = wanderingPoints(lasRecordBytes(format), 1000);
        const auto from = [&](int first, int last) {
            return std::vector<std::string>(points.begin() + first, points.begin() + last);
        };
        const std::string bytes = variableChunks(format, {from(0, 1), from(1, 700), from(700, 1000)});
        EXPECT_EQ(lazLayout(openLas(bytes)).chunks.size(), 3u);
        EXPECT_EQ(unpacked(bytes), joined(points));
    }
}

/// Writers to a pipe put the offset of the chunk table at the end; interrupted writers leave none.
TEST_F(LazTest, TablesElsewhereOrNowhere) {
    for (const std::uint8_t format : {1, 6}) {
        const auto points = wanderingPoints(lasRecordBytes(format), 50001);
        const std::string good = writeLas(format, points, true);
        const std::uint32_t at = openLas(good).header.point_offset;
        std::int64_t table;
        std::memcpy(&table, good.data() + at, sizeof table);
        std::string at_end = good, without = good.substr(0, static_cast<std::size_t>(table));
        put(at_end, at, std::int64_t{-1});
        put(at_end, at_end.size(), table);
        put(without, at, std::int64_t{-1});
        EXPECT_FALSE(lazLayout(openLas(at_end)).in_one_run);
        EXPECT_EQ(unpacked(at_end), joined(points));
        EXPECT_TRUE(lazLayout(openLas(without)).in_one_run);
        EXPECT_EQ(unpacked(without), joined(points)) << int{format};
    }
}

std::string reasonOfUnpacking(const std::string& bytes) {
    try {
        unpacked(bytes);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadInput) << error.what();
        return error.what();
    }
    return "";
}

TEST_F(LazTest, BillionsOfPointsInAFewBytesAreRefused) {
    std::string bytes = writeLas(0, wanderingPoints(20, 100), true);
    put(bytes, 107, ~std::uint32_t{0});
    EXPECT_SAYS(reasonOfUnpacking(bytes), "promises 4294967295 ");
}

TEST_F(LazTest, UnknownCompressorsAreNamed) {
    const std::string good = writeLas(0, wanderingPoints(20, 100), true);
    std::string bytes = good;
    bytes[bytes.find("laszip encoded")] = 'L';
    EXPECT_SAYS(reasonOfUnpacking(bytes), "*'laszip encoded'");
    const std::size_t record = good.find("laszip encoded") - 2 + 54;
    bytes = good;
    put(bytes, record, std::uint16_t{9});
    EXPECT_SAYS(reasonOfUnpacking(bytes), "*compressor (9)");
    bytes = good;
    put(bytes, record + 36, std::uint16_t{300}); // bytes of its item
    EXPECT_EQ(reasonOfUnpacking(bytes).find("compressed points: "), std::string::npos) << "the item knows its size";
    bytes = good;
    put(bytes, record + 34, std::uint16_t{7}); // a time in place of a point
    EXPECT_SAYS(reasonOfUnpacking(bytes), "compressed points: *8*20");
}

/// Layers that promise gigabytes take none of the memory.
TEST_F(LazTest, LayersThatPromiseGigabytes) {
    const auto points = wanderingPoints(30, 10);
    std::string bytes = writeLas(6, points, true);
    const std::size_t sizes = openLas(bytes).header.point_offset + 8 + 30 + 4;
    for (std::size_t layer = 0; layer < 9; ++layer) {
        std::string broken = bytes;
        put(broken, sizes + 4 * layer, std::uint32_t{0xF0000000});
        EXPECT_SAYS(reasonOfUnpacking(broken), "compressed points: *cut");
    }
}

TEST_F(LazTest, EveryPrefixAndEveryByteIsReadOrRefused) {
    for (const std::uint8_t format : {3, 7}) {
        const std::string good = writeLas(format, wanderingPoints(lasRecordBytes(format), 12), true);
        for (std::size_t size = 0; size < good.size(); ++size) reasonOfUnpacking(good.substr(0, size));
        for (std::size_t at = 0; at < good.size(); ++at)
            for (const char byte : {'\0', '\1', '\xff'}) {
                std::string bytes = good;
                bytes[at] = byte;
                reasonOfUnpacking(bytes);
            }
    }
}

} // namespace
} // namespace pointrt
