// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using XyzTest = InputTest;

TEST_F(XyzTest, DelimitersAndComments) {
    for (const char* text : {"1 2 3\n4 5 6\n", "1\t2\t3\r\n4\t5\t6\r\n", "1,2,3\n4,5,6", "1; 2; 3\n4; 5; 6\n",
                             "1,2,3,\n4,5,6,\n", "# list\n\n// of points\n1 2 3\n#\n  4  5 6  \n",
                             "\"1\",\"2\",\"3\"\n\"4\",\"5\",\"6\"\n", "2\n1 2 3\n4 5 6\n", "+1 2e0 3.0\n4 5. 6\n",
                             "\xef\xbb\xbf"
                             "1 2 3\n4 5 6\n",
                             "1\n1 2 3\n1\n4 5 6\n"}) {
        const Cloud cloud = readText("a.xyz", text);
        ASSERT_EQ(cloud.positions.size(), 2u) << text;
        EXPECT_EQ(world(cloud, 0), Vec3d(1, 2, 3)) << text;
        EXPECT_EQ(world(cloud, 1), Vec3d(4, 5, 6)) << text;
        EXPECT_TRUE(cloud.normals.empty() && cloud.colors.empty());
    }
}

TEST_F(XyzTest, HeadersNameColumns) {
    for (const char* header :
         {"label,\"Z\",\"Y\",\"X\",R,G,B,nx,ny,nz\n", "//label Z Y X R G B Nx Ny Nz\n",
          "# label z y x [m] red green blue\nlabel;z[m];y (m);x;red;green;blue;normal_x;normal_y;normal_z\n"}) {
        const bool commas = std::strchr(header, ',') != nullptr;
        const bool semicolons = std::strchr(header, ';') != nullptr;
        const char delimiter = commas ? ',' : semicolons ? ';' : ' ';
        std::string row = "tree 3 2 1 10 20 30 0 0 1\n";
        std::replace(row.begin(), row.end(), ' ', delimiter);
        const Cloud cloud = readText("a.csv", header + row);
        EXPECT_EQ(world(cloud, 0), Vec3d(1, 2, 3)) << header;
        ASSERT_EQ(cloud.colors.size(), 1u) << header;
        EXPECT_EQ(cloud.colors[0], (Rgb8{10, 20, 30}));
        EXPECT_EQ(cloud.normals[0], Vec3f(0, 0, 1));
    }
}

struct Meaning {
    const char* text;
    bool colors, normals;
    Rgb8 color;
    Vec3f normal;
};

TEST_F(XyzTest, ColumnsWithoutHeaderAreToldByValue) {
    const Rgb8 rgb = {10, 20, 30};
    const Vec3f up(0, 0, 1);
    const Meaning meanings[] = {
        {"1 2 3 7\n1 2 3 8\n", false, false, {}, {}},
        {"1 2 3 10 20 30\n1 2 3 0 0 255\n", true, false, rgb, {}},
        {"1 2 3 0 0 1\n1 2 3 0 -1 0\n", false, true, {}, up},
        {"1 2 3 0 0 1\n1 2 3 0 0.6 0.8\n", false, true, {}, up},
        {"1 2 3 0 0 5.5\n1 2 3 0 -1 0\n", false, false, {}, {}},
        {"1 2 3 -1613 10 20 30\n1 2 3 5 1 1 1\n", true, false, rgb, {}},
        {"1 2 3 99 10 20 30\n1 2 3 5 1 1 1\n", true, false, rgb, {}},
        {"1 2 3 10.0 20.0 30.0 255.0\n1 2 3 1 1 1 255\n", true, false, rgb, {}},
        {"1 2 3 10 20 30 0 0 1\n1 2 3 1 1 1 0 1 0\n", true, true, rgb, up},
        {"1 2 3 0 0 1 10 20 30\n1 2 3 0 1 0 1 1 1\n", true, true, rgb, up},
        {"1 2 3 0 0 1 10 20 30 255\n1 2 3 0 1 0 1 1 1 255\n", true, true, rgb, up},
        {"1 2 3 2560 5120 7680\n1 2 3 0 0 65535\n", true, false, rgb, {}},
        {"1 2 3 0.0392 0.0784 0.1176\n1 2 3 0 0 0.5\n", true, false, rgb, {}},
    };
    for (const Meaning& meaning : meanings) {
        const Cloud cloud = readText("a.xyz", meaning.text);
        ASSERT_EQ(!cloud.colors.empty(), meaning.colors) << meaning.text;
        ASSERT_EQ(!cloud.normals.empty(), meaning.normals) << meaning.text;
        if (meaning.colors) {
            EXPECT_EQ(cloud.colors[0], meaning.color) << meaning.text;
        }
        if (meaning.normals) {
            EXPECT_EQ(cloud.normals[0], meaning.normal) << meaning.text;
        }
    }
}

TEST_F(XyzTest, NationalGridKeepsMillimetres) {
    const Cloud cloud = readText("a.xyz", "500000.001 4500000.002 170.003\n500100.999 4500100.998 171.997\n");
    EXPECT_EQ(cloud.origin, Vec3d(500000, 4500000, 170));
    EXPECT_LT((world(cloud, 0) - Vec3d(500000.001, 4500000.002, 170.003)).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT((world(cloud, 1) - Vec3d(500100.999, 4500100.998, 171.997)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(XyzTest, OriginIsWholeAndKeepsSmallCoordinates) {
    EXPECT_EQ(readText("a.xyz", "-0.5 0.25 -7.75\n").origin, Vec3d(0, 0, -7));
    EXPECT_FALSE(std::signbit(readText("a.xyz", "-0.5 0.25 -7.75\n").origin[0]));
    const Cloud cloud = readText("b.xyz", "0.1234567 0.2 0.3\n");
    EXPECT_EQ(cloud.positions[0], Vec3f(0.1234567f, 0.2f, 0.3f));
}

TEST_F(XyzTest, NonFiniteValues) {
    const Cloud cloud =
        readText("a.xyz", "nan nan nan\n1 2 3\ninf 0 0\n-1.#IND 0 0\n1e999 0 0\n1e-999 2 3\n-nan 1 1\n");
    EXPECT_EQ(cloud.points_read, 7u);
    EXPECT_EQ(cloud.points_non_finite, 5u);
    EXPECT_EQ(world(cloud, 1), Vec3d(0, 2, 3));
}

TEST_F(XyzTest, BadFilesSayWhy) {
    EXPECT_HAS(reasonOfText("a.txt", "Dear reader,\nthis is prose.\n"), "a.txt:1: is neither a point nor a header");
    EXPECT_HAS(reasonOfText("a.xyz", "1 2 3\n4 5\n"), "a.xyz:2: has 2 columns, 3 are needed");
    EXPECT_HAS(reasonOfText("a.xyz", "1 2 3\n4 five 6\n"), "a.xyz:2: column 2 is no number: 'five'");
    EXPECT_HAS(reasonOfText("a.csv", "1,5;2,5;3,5\n"), "a.csv:1: is neither");
    EXPECT_HAS(reasonOfText("a.csv", "x,y,z\n1,,3\n"), "a.csv:2: column 2 is no number: ''");
    EXPECT_HAS(reasonOfText("a.pts", "3\n1 2 3\n4 5 6\n"), "cut short: 2 of 3 points are there");
    EXPECT_HAS(reasonOfText("a.xyz", "# nothing\n"), "holds no points");
    EXPECT_HAS(reasonOfText("a.ptx", "2\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n"),
               "is a PTX scan; this build reads PLY");
}

TEST_F(XyzTest, EveryPrefixIsReadOrRefused) {
    readPrefixes("a.csv", "\"x\",\"y\",\"z\",r,g,b\n1,2,3,4,5,6\n\"1\",2,3,4,5,6\n");
    readPrefixes("a.pts", "2\n1 2 3 -4 5 6 7\n1 2 3 4 5 6 7\n");
}

} // namespace
} // namespace pointrt
