// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/input_fixture.h"

#include <array>

#include "pointrt/pro_layout.h"

namespace pointrt {
namespace {

using InputFileTest = InputTest;

TEST_F(InputFileTest, FilesThatCannotBeRead) {
    EXPECT_HAS(reasonOf((folder / "gone.ply").string()), "gone.ply: *no such");
    EXPECT_HAS(reasonOf(folder.string()), "directory");
    EXPECT_HAS(reasonOfText("a.ply", ""), "a.ply: *empty");
    EXPECT_HAS(reasonOf("/dev/null"), "/dev/null: *regular");
    EXPECT_EQ(last_code, ExitCode::kBadInput);
}

TEST_F(InputFileTest, FilesWithoutPermission) {
    const std::string closed = write("closed.xyz", "1 2 3\n");
    std::filesystem::permissions(closed, std::filesystem::perms::none);
    if (::access(closed.c_str(), R_OK) == 0) GTEST_SKIP() << "running as root, who ignores permissions";
    EXPECT_HAS(reasonOf(closed), "permission");
}

TEST_F(InputFileTest, ContentDecidesTheFormatBeforeTheSuffix) {
    EXPECT_EQ(readText("really.ply", "v 1 2 3\nv 4 5 6\n").positions.size(), 2u);
    EXPECT_EQ(readText("a.obj", "OFF\n1 0 0\n1 2 3\n").positions.size(), 1u);
    EXPECT_EQ(readText("noname", "1 2 3\n").positions.size(), 1u);
    EXPECT_EQ(readText("a.xyz", "FIELDS x y z\nWIDTH 1\nDATA ascii\n1 2 3\n").positions.size(), 1u);
    EXPECT_HAS(reasonOfText("a.ply", "1 2 3\n"), "'ply'");
    EXPECT_EQ(read(write("b.ply", "1 2 3\n"), {.format = "xyz"}).positions.size(), 1u);
}

TEST_F(InputFileTest, FormatsOfScannerMakersNameTheProgramThatExports) {
    const std::pair<const char*, const char*> programs[] = {
        {"fls", "FARO SCENE"},    {"fws", "FARO SCENE"},    {"zfs", "LaserControl"},      {"rxp", "RiSCAN PRO"},
        {"rcp", "ReCap"},         {"rcs", "ReCap"},         {"ptg", "Leica Cyclone"},     {"imp", "Leica Cyclone"},
        {"lgs", "REGISTER 360"},  {"lgsx", "REGISTER 360"}, {"tzf", "Trimble RealWorks"}, {"dp", "Dot3D"},
        {"cl3", "MAGNET Collage"}};
    for (const auto& [suffix, program] : programs)
        for (const char* const bytes : {"binary \1\2\3", "1 2 3\n4 5 6\n"}) // text as well
            EXPECT_HAS(reasonOfText(std::string("a.") + suffix, bytes), std::string("E57*") + program);
}

TEST_F(InputFileTest, ForeignFormatsAreNamed) {
    EXPECT_HAS(reasonOfText("a.fbx", "Kaydara FBX Binary"), "FBX *reads PLY");
    EXPECT_HAS(reasonOfText("a.grd", "DSAA\n2 2\n0 1\n0 1\n0 1\n"), "Surfer *gdal_translate");
    EXPECT_HAS(reasonOfText("a.bin", "CCB2\x34"), "CloudCompare *LAS");
    EXPECT_HAS(reasonOfText("a.ply", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n"), "Git LFS");
    EXPECT_HAS(reasonOfText("a.zip", "PK\3\4rest"), " zip ");
    EXPECT_HAS(reasonOfText("a.dat", std::string("\0\1\2\3", 4)), "unknown format");
    EXPECT_HAS(reasonOfText("u.xyz", std::string("\xff\xfe"
                                                 "1\0 \0"
                                                 "2\0",
                                                 8)),
               "UTF-16 *UTF-8");
    EXPECT_HAS(reasonOfText("u.xyz", std::string("\xfe\xff\0"
                                                 "1\0 ",
                                                 6)),
               "UTF-16");
    const std::array<std::uint32_t, 2> magic = {PRO_MAGIC_WORD0, PRO_MAGIC_WORD1};
    EXPECT_HAS(reasonOfText("a.pro", bytesOf(magic)), "baked*pointrt-view");
    EXPECT_HAS(reasonOfText("a.tar.gz", gzipped(std::string(257, 'n') + "ustar" + std::string(800, '\0'))),
               " tar *: unpack");
    EXPECT_HAS(reasonOfText("a.ksplat", std::string(64, '\0')), "Gaussian splats*reads PLY");
    EXPECT_HAS(reasonOfText("a.dae", "<COLLADA>\n"), "3D model*reads PLY");
    EXPECT_HAS(reasonOfText("a.ply", "<!DOCTYPE html><title>404"), "web page");
    EXPECT_HAS(reasonOfText("a.toml", "[camera]\n"), "scene file*pointrt-view");
    EXPECT_HAS(reasonOf(write("a.xyz", "1 2 3\n"), {.format = "3mf"}), "format '3mf'");
    EXPECT_EQ(last_code, ExitCode::kBadUsage);
}

TEST_F(InputFileTest, ControlCharactersDoNotReachTheMessage) {
    const std::string reason = reasonOfText("a.xyz", "1 2 3\n1 2 \x1b[2J" + std::string(200, 'x') + "\n");
    EXPECT_EQ(reason.find('\x1b'), std::string::npos);
    EXPECT_LT(reason.size(), folder.string().size() + 300);
}

TEST_F(InputFileTest, GzipIsUnpacked) {
    const std::string packed = gzipped("1 2 3\n4 5 6\n");
    EXPECT_EQ(readText("a.xyz.gz", packed).positions.size(), 2u);
    EXPECT_EQ(readText("b.xyz", packed + gzipped("7 8 9\n")).positions.size(), 3u);
    EXPECT_HAS(reasonOfText("c.xyz", packed.substr(0, packed.size() - 9)), "gzip *truncated");
    EXPECT_HAS(reasonOfText("d.xyz", packed.substr(0, 10) + "\xff\xff\xff\xff"), "gzip *invalid");
    EXPECT_HAS(reasonOfText("e.ply.gz", gzipped("plx")), "'ply'");
    readPrefixes("f.xyz", packed);
}

TEST_F(InputFileTest, GzipGrowsInProportion) {
    const std::string header = "1 2 3\n";
    // 64 MiB plus 100 times the size are allowed: blanks compress to a thousandth.
    const std::string scan = header + std::string((64 << 20) - header.size(), ' ');
    EXPECT_EQ(readText("a.xyz.gz", gzipped(scan)).positions.size(), 1u);
    EXPECT_HAS(reasonOfText("b.xyz.gz", gzipped(scan + std::string(16 << 20, ' '))), "b.xyz.gz: *100 times");
}

TEST_F(InputFileTest, FilesAreMergedAndFilled) {
    const std::string plain = write("a.xyz", "1 2 3\n"), colored = write("b.xyz", "4 5 6 7 8 9\n4 5 6 70 80 90\n");
    const std::string directed = write("c.xyz", "4 5 6 0 0 1\n");
    const Cloud cloud = readInputs({plain, colored, directed}, {});
    EXPECT_EQ(cloud.points_read, 4u);
    EXPECT_EQ(cloud.origin, Vec3d(1, 2, 3));
    EXPECT_EQ(cloud.colors, (std::vector<Rgb8>{{200, 200, 200}, {7, 8, 9}, {70, 80, 90}, {200, 200, 200}}));
    EXPECT_EQ(cloud.normals, (std::vector<Vec3f>{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 1}}));
}

TEST_F(InputFileTest, MergedFacesPointToTheirOwnVertices) {
    const std::string points = write("a.xyz", "1 2 3\n4 5 6\n");
    const std::string mesh = write("b.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    const Cloud cloud = readInputs({points, mesh, mesh}, {});
    ASSERT_EQ(cloud.triangles.size(), 2u);
    EXPECT_EQ(cloud.triangles[1], (std::array<std::uint32_t, 3>{5, 6, 7}));
    EXPECT_EQ(cloud.normals[0], Vec3f(0, 0, 0));
    EXPECT_EQ(cloud.normals[5], Vec3f(0, 0, 1));
}

TEST_F(InputFileTest, ProgressEndsAtOne) {
    std::vector<double> shares;
    const std::string path = write("a.xyz", "1 2 3\n4 5 6\n");
    readInputs({path, path}, {}, [&](const ReadStatus& status) { shares.push_back(status.share); });
    ASSERT_FALSE(shares.empty());
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_EQ(shares.back(), 1);
}

} // namespace
} // namespace pointrt
