// SPDX-License-Identifier: Apache-2.0
// Files that are cut short, or promise more than they hold: --salvage reads the whole points.
#include "tests/preprocess/input/input_fixture.h"
#include "tests/support/las_file.h"

#include "format/pointio/laz.h"
#include "tests/support/packed_las.h"

namespace pointrt {
namespace {

struct SalvageTest : InputTest {
    static ReadOptions salvaging() {
        ReadOptions options;
        options.salvages = true;
        return options;
    }
    /// Without the option the error names both counts and the option; with it, `found` points are read and a note is
    /// printed.
    void expectSalvaged(const std::string& name, const std::string& bytes, std::size_t found, std::size_t promised,
                        const Vec3d& last) const {
        const std::string path = write(name, bytes);
        const std::string reason = reasonOf(path);
        EXPECT_HAS(reason, fmt::format("{}: *{}*--salvage", name, found));
        EXPECT_HAS(reason, fmt::format("{}: *{}*--salvage", name, promised));
        std::vector<FileReport> reports;
        const Cloud cloud = readInputs({path}, salvaging(), {}, &reports);
        ASSERT_EQ(cloud.positions.size(), found) << name;
        EXPECT_LT((world(cloud, found - 1) - last).norm(), 1e-5) << name;
        EXPECT_HAS(notesOf(cloud), fmt::format("{}: *{} of {} points", name, found, promised));
        EXPECT_EQ(reports.at(0).promised, promised);
    }
    /// Every prefix is read or refused, and reads no more points than the file has.
    void salvagePrefixes(const std::string& name, const std::string& bytes, std::size_t points) const {
        for (std::size_t size = 0; size <= bytes.size(); ++size) {
            const std::string path = write(name, bytes.substr(0, size));
            try {
                EXPECT_LE(readInputs({path}, salvaging()).positions.size(), points);
            } catch (const Error& error) {
                ASSERT_EQ(error.code, ExitCode::kBadInput) << error.what();
            }
        }
        EXPECT_EQ(readInputs({write(name, bytes)}, salvaging()).positions.size(), points);
    }
};

std::vector<std::string> records(std::size_t bytes, int count) {
    std::vector<std::string> all;
    for (int i = 0; i < count; ++i) {
        std::string record = test::lasPoint(bytes, 100 * i, int(7LL * i * i % 5000), i % 13, 0);
        std::fill(record.begin() + 12, record.end(), '\0');
        all.push_back(record);
    }
    return all;
}

TEST_F(SalvageTest, Las) {
    test::LasParts parts;
    parts.points = records(20, 10);
    const std::string good = parts.bytes();
    expectSalvaged("a.las", good.substr(0, good.size() - 30), 8, 10, Vec3d(7, 3.43, 0.07));
    salvagePrefixes("b.las", good, 10);
}

TEST_F(SalvageTest, LazThatEndsEarly) {
    if (!hasLaz()) GTEST_SKIP() << "this build has no LAZ";
    for (const std::uint8_t format : {std::uint8_t{0}, std::uint8_t{6}}) {
        const std::string good = test::writeLas(format, records(lasRecordBytes(format), 2000), true);
        const std::string path = write("a.laz", good.substr(0, good.size() * 3 / 4));
        EXPECT_HAS(reasonOf(path), "a.laz: ");
        // the layers of a chunk are stored one after another: a partial chunk has no complete point
        if (format == 6) continue;
        const Cloud cloud = readInputs({path}, salvaging());
        ASSERT_GT(cloud.positions.size(), 1000u);
        ASSERT_LT(cloud.positions.size(), 2000u);
        const Cloud whole = read(write("whole.laz", good));
        for (std::size_t i = 0; i < cloud.positions.size(); ++i) ASSERT_EQ(world(cloud, i), world(whole, i)) << i;
        EXPECT_HAS(notesOf(cloud), fmt::format("{} of 2000 points", cloud.positions.size()));
        EXPECT_HAS(reasonOf(path), fmt::format("{} of 2000 points *--salvage", cloud.positions.size()));
    }
}

TEST_F(SalvageTest, WholeChunksOfLayeredLaz) {
    if (!hasLaz()) GTEST_SKIP() << "this build has no LAZ";
    // our writer's chunks have 50,000 points, the last one the rest
    const std::string good = test::writeLas(6, records(lasRecordBytes(6), 120'000), true);
    const Cloud whole = read(write("whole.laz", good));
    std::size_t seen = 0;
    for (const double share : {0.99, 0.7, 0.5, 0.2}) {
        const std::string path =
            write("a.laz", good.substr(0, static_cast<std::size_t>(share * static_cast<double>(good.size()))));
        const std::size_t expected = share > 0.9 ? 100'000 : share > 0.45 ? 50'000 : 0;
        if (expected == 0) {
            EXPECT_HAS(reasonOf(path), "a.laz: ");
            continue;
        }
        EXPECT_HAS(reasonOf(path), fmt::format("{} of 120000 points *--salvage", expected));
        const Cloud cloud = readInputs({path}, salvaging());
        ASSERT_EQ(cloud.positions.size(), expected) << share;
        for (std::size_t i = 0; i < expected; i += 97) ASSERT_EQ(world(cloud, i), world(whole, i)) << i;
        EXPECT_HAS(notesOf(cloud), fmt::format("{} of 120000 points", expected));
        ++seen;
    }
    EXPECT_EQ(seen, 3u);
}

TEST_F(SalvageTest, LazThatPromisesMore) {
    if (!hasLaz()) GTEST_SKIP() << "this build has no LAZ";
    std::string bytes = test::writeLas(0, records(20, 500), true);
    const auto promise = [&](std::uint32_t points) {
        test::put(bytes, 107, points);
        if (bytes[25] >= 4) test::put(bytes, 247, std::uint64_t{points});
    };
    promise(511);
    const Cloud cloud = readInputs({write("a.laz", bytes)}, salvaging());
    EXPECT_EQ(cloud.positions.size(), 500u);
    EXPECT_HAS(notesOf(cloud), "500 of 511 points");
    EXPECT_HAS(reasonOf(write("a.laz", bytes)), "500 of 511 points *--salvage");
}

TEST_F(SalvageTest, Ply) {
    const std::string vertex = "property float x\nproperty float y\nproperty float z\n";
    const std::string head =
        "element vertex 4\n" + vertex + "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string ascii =
        "ply\nformat ascii 1.0\n" + head + "0.000 0.000 0.000\n1.000 0.000 0.000\n1 1 0\n0 1 1.5\n3 0 1 2\n3 0 2 3\n";
    // the 0 of the third vertex may be only the start of a number
    expectSalvaged("a.ply", ascii.substr(0, ascii.find("1 1 0") + 5), 2, 4, Vec3d(1, 0, 0));
    expectSalvaged("b.ply", ascii.substr(0, ascii.find("1 1 0") + 6), 3, 4, Vec3d(1, 1, 0));
    const Cloud faces = readInputs({write("c.ply", ascii.substr(0, ascii.find("3 0 2 3") + 3))}, salvaging());
    EXPECT_HAS(notesOf(faces), "c.ply: *1 of 2 faces");
    EXPECT_EQ(faces.triangles.size(), 1u);
    std::string binary = "ply\nformat binary_little_endian 1.0\n" + head;
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 1.5f}) binary += bytesOf(value);
    const std::size_t vertices = binary.size();
    for (const int last : {2, 3}) binary += "\3" + bytesOf(0) + bytesOf(last - 1) + bytesOf(last);
    expectSalvaged("d.ply", binary.substr(0, vertices - 5), 3, 4, Vec3d(1, 1, 0));
    salvagePrefixes("e.ply", binary, 4);
    salvagePrefixes("f.ply", ascii, 4);
}

TEST_F(SalvageTest, Pcd) {
    const std::string head =
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 2\nPOINTS 4\n";
    const std::string ascii = head + "DATA ascii\n0.000 0.000 0.000\n1.000 0 0\n1.25 1 0\n0 1 15\n";
    expectSalvaged("a.pcd", ascii.substr(0, ascii.find("1.25 1 0") + 3), 2, 4, Vec3d(1, 0, 0));
    expectSalvaged("b.pcd", ascii.substr(0, ascii.find("0 1 15") + 2), 3, 4, Vec3d(1.25, 1, 0));
    std::string binary = head + "DATA binary\n";
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 1.5f}) binary += bytesOf(value);
    expectSalvaged("c.pcd", binary.substr(0, binary.size() - 1), 3, 4, Vec3d(1, 1, 0));
    salvagePrefixes("d.pcd", ascii, 4);
    salvagePrefixes("e.pcd", binary, 4);
    std::string promise = ascii; // memory is not reserved for the promised points
    promise.replace(promise.find("WIDTH 2\nHEIGHT 2\nPOINTS 4"), 25,
                    "WIDTH 4000000000\nHEIGHT 4000000\nPOINTS 16000000000000000");
    EXPECT_EQ(readInputs({write("f.pcd", promise)}, salvaging()).positions.size(), 4u);
}

TEST_F(SalvageTest, CompressedPcd) {
    const std::string head = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 2\n"
                             "POINTS 4\nDATA binary_compressed\n";
    std::string columns; // x, y and z of all points, one after another
    for (const float value : {0.f, 1.f, 1.f, 0.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 0.f, 1.5f}) columns += bytesOf(value);
    const std::string packed = '\x1f' + columns.substr(0, 32) + '\x0f' + columns.substr(32);
    const auto sizes = [](std::size_t bytes) {
        return bytesOf(static_cast<std::uint32_t>(bytes)) + bytesOf(std::uint32_t{48});
    };
    const std::string good = head + sizes(packed.size()) + packed;
    expectSalvaged("a.pcd", good.substr(0, good.size() - 1), 3, 4, Vec3d(1, 1, 0));
    expectSalvaged("b.pcd", good.substr(0, good.size() - 5), 2, 4, Vec3d(1, 0, 0));
    salvagePrefixes("c.pcd", good, 4);
    // without any z there is no whole point
    EXPECT_HAS(reasonOf(write("d.pcd", good.substr(0, good.size() - 13))), "d.pcd: truncated *0 of 4 points");
    // z repeats y of the first three points; the bytes of the last one are cut
    const std::string back = '\x1f' + columns.substr(0, 32) + std::string("\xe0\x03\x0f", 3) + '\x03' + bytesOf(1.5f);
    expectSalvaged("e.pcd", head + sizes(back.size()) + back.substr(0, back.size() - 2), 3, 4, Vec3d(1, 1, 1));
    // a cut file reserves no memory for the points it promises
    std::string promise = head;
    promise.replace(promise.find("WIDTH 2\nHEIGHT 2\nPOINTS 4"), 25, "WIDTH 20000\nHEIGHT 15000\nPOINTS 300000000");
    promise += bytesOf(std::uint32_t{50'000'000}) + bytesOf(std::uint32_t{3'600'000'000}) + packed;
    EXPECT_HAS(reasonOf(write("f.pcd", promise)), "f.pcd: truncated *0 of 300000000 points");
}

TEST_F(SalvageTest, Ptx) {
    const std::string head = "2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    const std::string points = "1 0 0 0.5\n1 1 0 0.5\n1 0 1 0.5\n1 1 1 0.5\n";
    expectSalvaged("a.ptx", head + points.substr(0, points.size() - 6), 3, 4, Vec3d(1, 0, 1));
    const Cloud two = readInputs({write("b.ptx", head + points + head.substr(0, 30))}, salvaging());
    EXPECT_EQ(two.positions.size(), 4u);
    EXPECT_HAS(notesOf(two), "b.ptx: *scan 2");
    salvagePrefixes("c.ptx", head + points, 4);
}

TEST_F(SalvageTest, Text) {
    expectSalvaged("a.pts", "4\n1 2 3\n4 5 6\n7 8 9", 2, 4, Vec3d(4, 5, 6)); // 9 may be the start of 95
    expectSalvaged("b.pts", "4\n1 2 3\n4 5 6\n7 8 9\n", 3, 4, Vec3d(7, 8, 9));
    const std::string path = write("c.xyz", "1 2 3\n4 5 6\n7 8");
    EXPECT_HAS(reasonOf(path), "c.xyz:3: *--salvage *2 points");
    const Cloud cloud = readInputs({path}, salvaging());
    EXPECT_EQ(cloud.positions.size(), 2u);
    EXPECT_HAS(notesOf(cloud), "c.xyz: *last line");
    EXPECT_EQ(readInputs({write("d.xyz", "1 2 3\n4 5 6")}, salvaging()).positions.size(), 2u);
    expectSalvaged("e.asc", "ncols 2\nnrows 2\ncellsize 1\n1.000 2.000 3.000 ", 3, 4, Vec3d(0, 0, 3));
}

/// Each line feed gets a carriage return before it, as in a transfer in text mode.
TEST_F(SalvageTest, LasDamagedInTextModeIsNoted) {
    test::LasParts parts;
    parts.points = records(20, 300); // some coordinates have a byte of 10
    std::string bytes = parts.bytes();
    for (int axis = 0; axis < 3; ++axis) {
        test::put(bytes, 179 + 16 * axis, axis == 0 ? 299.0 : axis == 1 ? 50.0 : 0.12);
        test::put(bytes, 187 + 16 * axis, 0.0);
    }
    EXPECT_EQ(notesOf(readText("good.las", bytes)), "");
    std::string damaged = bytes.substr(0, 227);
    for (const char byte : bytes.substr(227)) {
        if (byte == 10) damaged += '\r';
        damaged += byte;
    }
    EXPECT_HAS(notesOf(readText("bad.las", damaged)), "bad.las: *text mode");
    for (int axis = 0; axis < 6; ++axis) test::put(damaged, 179 + 8 * axis, 0.0); // without bounds to detect it by
    EXPECT_HAS(notesOf(readText("worse.las", damaged)), "worse.las: *text mode");
}

TEST_F(SalvageTest, FramesOfDrivingDatasets) {
    std::string kitti, nuscenes;
    for (int i = 0; i < 40; ++i) {
        for (const float value : {3.0f + static_cast<float>(i), 2.0f, -1.5f, 0.25f}) kitti += bytesOf(value);
        for (const float value : {3.0f + static_cast<float>(i), 2.0f, -1.5f, 25.0f, static_cast<float>(i % 32)})
            nuscenes += bytesOf(value);
    }
    const Cloud frame = readText("0001.bin", kitti);
    ASSERT_EQ(frame.positions.size(), 40u);
    EXPECT_EQ(world(frame, 39), Vec3d(42, 2, -1.5));
    EXPECT_EQ(numbersOf(frame, "intensity").at(0), 0.25);
    EXPECT_EQ(frame.scans.at(0).sensor, Vec3d(0, 0, 0));
    EXPECT_EQ(frame.world.up, Vec3d(0, 0, 1));
    const Cloud rings = readText("0001.pcd.bin", nuscenes);
    ASSERT_EQ(rings.positions.size(), 40u);
    EXPECT_EQ(numbersOf(rings, "ring").at(33), 1);
    EXPECT_HAS(reasonOfText("b.bin", kitti + "x"), "b.bin: *641 bytes");
    EXPECT_HAS(reasonOfText("c.bin", std::string(640, '\x7f')), "c.bin: ");
    EXPECT_HAS(reasonOfText("d.bin", std::string(640, '\0')), "d.bin: ");
    EXPECT_HAS(reasonOfText("e.txt", std::string(640, 'a')), "e.txt:1: *neither");
}

} // namespace
} // namespace pointrt
