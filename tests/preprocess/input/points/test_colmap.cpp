// SPDX-License-Identifier: Apache-2.0
// Sparse models of COLMAP: points with the photographs that show them.
#include "preprocess/input/folders.h"
#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using ColmapTest = InputTest;

template <typename... Values>
std::string packed(Values... each) {
    return (bytesOf(each) + ...);
}

std::string colmapPoint(std::uint64_t id, double x, std::uint32_t image) {
    return packed(id, x, 2.0, 3.0) + "\x0a\x14\x1e" + packed(0.5, std::uint64_t{1}, image, 0u);
}

/// Two points: the first seen by photograph 4, the second by photograph 3.
std::string colmapPoints() { return packed(std::uint64_t{2}) + colmapPoint(1, 1, 4) + colmapPoint(2, 9, 3); }

/// Photographs 3 and 4 look along z from (0, 0, -5) and (7, 0, -5), with y down.
std::string photographs() {
    const std::string none = packed(std::uint64_t{0});
    return packed(std::uint64_t{2}) + packed(3u, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 5.0, 1u) + std::string("a.jpg\0", 6) +
           none + packed(4u, 1.0, 0.0, 0.0, 0.0, -7.0, 0.0, 5.0, 1u) + std::string("b.jpg\0", 6) + none;
}

void expectModel(const Cloud& cloud) {
    ASSERT_EQ(cloud.positions.size(), 2u);
    ASSERT_EQ(cloud.scans.size(), 2u); // by photograph: 3, then 4
    EXPECT_EQ(world(cloud, 0), Vec3d(9, 2, 3));
    EXPECT_EQ(world(cloud, 1), Vec3d(1, 2, 3));
    EXPECT_EQ(*cloud.scans[0].sensor, Vec3d(0, 0, -5));
    EXPECT_EQ(*cloud.scans[1].sensor, Vec3d(7, 0, -5));
    EXPECT_EQ(cloud.colors[0], (Rgb8{10, 20, 30}));
    EXPECT_EQ(numbersOf(cloud, "error"), (Numbers{0.5, 0.5}));
    EXPECT_EQ(numbersOf(cloud, "track_length"), (Numbers{1, 1}));
    EXPECT_EQ(cloud.world.up, Vec3d(0, -1, 0));
}

TEST_F(ColmapTest, BinaryModelsByTheirFolder) {
    write("images.bin", photographs());
    write("points3D.bin", colmapPoints());
    write("cameras.bin", packed(std::uint64_t{0}));
    const std::vector<std::string> files = filesOf({folder.string()});
    ASSERT_EQ(files.size(), 1u);
    const Cloud cloud = readInputs(files, {});
    expectModel(cloud);
    EXPECT_HAS(cloud.scans[1].name, "b.jpg");
}

TEST_F(ColmapTest, TextModels) {
    write("images.txt", "# Image list\n3 1 0 0 0 0 0 5 1 a.jpg\n1 2 -1\n4 1 0 0 0 -7 0 5 1 b.jpg\n\n");
    expectModel(readText("points3D.txt", "# 3D point list with one line of data per point:\n"
                                         "1 1 2 3 10 20 30 0.5 4 0\n2 9 2 3 10 20 30 0.5 3 0\n"));
}

TEST_F(ColmapTest, PointsWithoutPhotographs) {
    const Cloud cloud = readText("points3D.bin", colmapPoints());
    EXPECT_EQ(cloud.positions.size(), 2u);
    EXPECT_FALSE(cloud.scans.at(0).sensor.has_value());
    EXPECT_HAS(notesOf(cloud), "images.bin");
}

TEST_F(ColmapTest, MalformedLinesAndImagesAreNamed) {
    const std::string mark = "# 3D point list\n";
    EXPECT_HAS(reasonOfText("points3D.txt", mark + "1 1 2 3 10 20 30\n"), "points3D.txt:2");
    write("images.txt", "3 1 0 0 0\n");
    EXPECT_HAS(reasonOfText("points3D.txt", mark + "1 1 2 3 10 20 30 0.5 4 0\n"), "images.txt:1");
}

TEST_F(ColmapTest, DamagedFilesAreReadOrRefused) {
    write("images.bin", photographs());
    readPrefixes("points3D.bin", colmapPoints());
    readChangedBytes("points3D.bin", colmapPoints());
    const std::string whole = photographs();
    const std::string path = write("points3D.bin", colmapPoints());
    for (std::size_t size = 0; size < whole.size(); ++size) {
        write("images.bin", whole.substr(0, size));
        reasonOf(path);
        EXPECT_EQ(last_code, ExitCode::kBadInput);
    }
}

} // namespace
} // namespace pointrt
