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

TEST_F(XyzTest, ColumnsWithoutHeaderAreGuessedFromValues) {
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
        {"1 2 3 10 20 30 0.5\n1 2 3 1 1 1 0.25\n", true, false, rgb, {}},
        {"1 2 3 0.5 10 20 30\n1 2 3 0.25 1 1 1\n", true, false, rgb, {}},
        {"1 2 3 10 20 30 1024\n1 2 3 1 1 1 5\n", true, false, rgb, {}},
        {"1 2 3 10 20 30 -1613\n1 2 3 1 1 1 5\n", true, false, rgb, {}},
        {"1 2 3 1024 10 20 30\n1 2 3 5 1 1 1\n", true, false, rgb, {}},
        {"1 2 3 2560 5120 7680 99\n1 2 3 65535 300 300 7\n", true, false, rgb, {}},
        {"1 2 3 99 2560 5120 7680\n1 2 3 7 65535 300 300\n", true, false, rgb, {}},
        {"1 2 3 10 20 30 0\n1 2 3 1 1 1 0\n", true, false, rgb, {}},
        {"1 2 3 0 10 20 30\n1 2 3 0 1 1 1\n", true, false, rgb, {}},
        {"1 2 3 0.0392 0.0784 0.1176 99\n1 2 3 0 0 0.5 5\n", true, false, rgb, {}},
        {"1 2 3 0 0 1 0.5\n1 2 3 0 1 0 7\n", false, true, {}, up},
        {"1 2 3 0.5 0 0 1\n1 2 3 7 0 1 0\n", false, true, {}, up},
        {"1 2 3 0 0 1\n1 2 3 0 0 0\n1 2 3 nan nan nan\n", false, true, {}, up},
        {"1 2 3 10 20 30 500 0 0 1\n1 2 3 1 1 1 5 0 1 0\n", true, true, rgb, up},
        {"1 2 3 500 10 20 30 0 0 1\n1 2 3 5 1 1 1 0 1 0\n", true, true, rgb, up},
        {"1 2 3 0 0 1 500 10 20 30\n1 2 3 0 1 0 5 1 1 1\n", true, true, rgb, up},
        {"1 2 3 0.5 0 0 1 10 20 30\n1 2 3 7.5 0 1 0 1 1 1\n", true, true, rgb, up},
        {"1 2 3 200.5 99.25 30.5\n1 2 3 1.5 1.5 1.5\n", false, false, {}, {}},
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

TEST_F(XyzTest, DoubtfulGuessesAreNoted) {
    const auto notes = [&](const char* text) { return notesOf(readText("a.xyz", text)); };
    EXPECT_HAS(notes("1 2 3 99 10 20 30\n1 2 3 5 1 1 2\n"), "a.xyz: *header*5 to 7 *red");
    EXPECT_HAS(notes("1 2 3 10 20 30 99 0 0 1\n1 2 3 1 1 2 5 0 1 0\n"), "4 to 6 *red");
    EXPECT_HAS(notes("1 2 3 0.1 0.2 0.3 0.4\n1 2 3 0 0 0 0.5\n"), "5 to 7 *red");
    EXPECT_HAS(notes("1 2 3 200.5 99.25 30.5\n1 2 3 1.5 1.5 1.5\n"), "3 columns *x, y, z *neither");
    EXPECT_HAS(notes("1 2 3 4 5 6 7 8\n1 2 3 4 5 6 7 9\n"), "5 columns *x, y, z *neither");
    EXPECT_HAS(notes("1 2 3 0 0 1 9.5 8.5 7.5\n1 2 3 0 1 0 1 1 1\n"), "3 columns *x, y, z and normals");
    EXPECT_HAS(notes("1 2 3 4\n"), "1 column *x, y, z *neither");
    EXPECT_HAS(notes("1 2 3 4 5\n"), "2 columns *x, y, z *neither");
    EXPECT_HAS(notes("1 2 3 0 0 1 0.5\n1 2 3 0 1 0 7\n"), "1 column *x, y, z and normals");
    for (const char* clear : {"1 2 3\n", "1\n1 2 3 4\n", "1 2 3 10 20 30\n", "1 2 3 0 0 1\n",
                              "2\n1 2 3 99 10 20 30\n1 2 3 5 1 1 2\n", "//X Y Z R G B I\n1 2 3 99 10 20 30\n",
                              "1 2 3 0 10 20 30\n1 2 3 0 1 1 2\n", "1 2 3 10 20 30 0.5\n1 2 3 1 1 1 0.25\n"})
        EXPECT_EQ(notes(clear), "") << clear;
}

TEST_F(XyzTest, HeadersOfCloudCompare) {
    const Rgb8 rgb = {51, 102, 204};
    const Vec3f up(0, 0, 1);
    const Meaning meanings[] = {
        {"//X Y Z Rf Gf Bf\n1 2 3 0.2 0.4 0.8\n1 2 3 0 0 1\n", true, false, rgb, {}},
        {"//X Y Z Rf Gf Bf Nx Ny Nz\n1 2 3 0.2 0.4 0.8 0 0 1\n1 2 3 0 0 1 0 0 1\n", true, true, rgb, up},
        {"//X Y Z R G B Intensity Nx Ny Nz\n1 2 3 51 102 204 7000 0 0 1\n", true, true, rgb, up},
        {"//X Y Z R G B A\n1 2 3 51 102 204 255\n", true, false, rgb, {}},
        {"//X Y Z Scalar_field R G B\n1 2 3 9.5 51 102 204\n", true, false, rgb, {}},
        {"//X Y Z Rf Gf Bf\n2\n1 2 3 0.2 0.4 0.8\n1 2 3 0 0 1\n", true, false, rgb, {}},
        {"x,y,z,nx,ny,nz,red,green,blue\n1,2,3,0,0,1,51,102,204\n", true, true, rgb, up},
    };
    for (const Meaning& meaning : meanings) {
        const Cloud cloud = readText("a.asc", meaning.text);
        ASSERT_EQ(!cloud.colors.empty(), meaning.colors) << meaning.text;
        ASSERT_EQ(!cloud.normals.empty(), meaning.normals) << meaning.text;
        EXPECT_EQ(cloud.colors[0], meaning.color) << meaning.text;
        if (meaning.normals) {
            EXPECT_EQ(cloud.normals[0], meaning.normal) << meaning.text;
        }
    }
}

TEST_F(XyzTest, NamedColumnsAreAttributes) {
    const Cloud cloud =
        readText("a.csv", "\"X\",\"Y\",\"Z\",\"Intensity\",\"ReturnNumber\",\"GpsTime\",\"Classification\",\"Foo\"\n"
                          "1,2,3,65535,1,413665.23368423499,2,0.25\n4,5,6,7,2,413665.2336850,-1,0.5\n");
    EXPECT_EQ(attributeNames(cloud), (Names{"intensity", "return_number", "gps_time", "classification", "Foo"}));
    EXPECT_EQ(attributeOf(cloud, "intensity").type, Scalar::kU16);
    EXPECT_EQ(numbersOf(cloud, "intensity"), (Numbers{65535, 7}));
    EXPECT_EQ(attributeOf(cloud, "return_number").type, Scalar::kU8);
    EXPECT_EQ(attributeOf(cloud, "gps_time").type, Scalar::kF64);
    EXPECT_EQ(numbersOf(cloud, "gps_time"), (Numbers{413665.23368423499, 413665.2336850}));
    EXPECT_EQ(attributeOf(cloud, "classification").type, Scalar::kI8);
    EXPECT_EQ(attributeOf(cloud, "Foo").type, Scalar::kF32);
    EXPECT_EQ(notesOf(cloud), "");
    EXPECT_TRUE(cloud.world.up.isZero());
}

TEST_F(XyzTest, CloudComparesScalarFields) {
    const Cloud cloud =
        readText("a.asc", "//X Y Z R G B Scalar_Intensity Scalar_field Nx Ny Nz\n2\n1 2 3 51 102 204 -7 0.5 0 0 1\n"
                          "1 2 4 51 102 204 8 0.25 0 0 1\n");
    EXPECT_EQ(attributeNames(cloud), (Names{"intensity", "Scalar_field"}));
    EXPECT_EQ(numbersOf(cloud, "intensity"), (Numbers{-7, 8}));
    EXPECT_EQ(numbersOf(cloud, "Scalar_field"), (Numbers{0.5, 0.25}));
    EXPECT_EQ(numbersOf(readText("i.txt", "# x y z i\n1 2 3 44\n"), "intensity"), Numbers{44});
}

TEST_F(XyzTest, IntensitiesOfLists) {
    const auto intensity = [&](const char* text) { return numbersOf(readText("a.pts", text), "intensity"); };
    EXPECT_EQ(intensity("2\n1 2 3 -2048\n1 2 4 2047\n"), (Numbers{-2048, 2047}));
    EXPECT_EQ(intensity("2\n1 2 3 0.5 10 20 30\n1 2 3 0.25 1 1 1\n"), (Numbers{0.5, 0.25}));
    EXPECT_EQ(intensity("1\n1 2 3 99 10 20 30\n1\n1 2 3 5 1 1 2\n"), (Numbers{99, 5}));
    EXPECT_EQ(intensity("1 2 3 10 20 30 -1613\n1 2 3 1 1 1 5\n"), (Numbers{-1613, 5}));
    for (const char* text : {"1 2 3 7\n1 2 3 8\n", "1 2 3 10 20 30 255\n1 2 3 1 1 1 255\n",
                             "2\n1 2 3 10 20 30\n1 2 3 1 1 1\n", "1 2 3 99 10 20 30\n1 2 3 5 1 1 2\n"})
        EXPECT_EQ(attributeNames(readText("a.xyz", text)), Names{}) << text;
    EXPECT_EQ(readText("a.pts", "1\n1 2 3 4\n").world.up, Vec3d(0, 0, 1));
}

TEST_F(XyzTest, MissingAttributeValuesAreNoted) {
    const Cloud cloud = readText("a.csv", "x,y,z,height,tree\n1,2,3,4,oak\n1,2,4,,oak\n1,2,5\n1,2,6,tall,elm\n");
    EXPECT_EQ(attributeNames(cloud), Names{"height"});
    const Numbers height = numbersOf(cloud, "height");
    ASSERT_EQ(height.size(), 4u);
    EXPECT_EQ(height[0], 4);
    EXPECT_TRUE(std::isnan(height[1]) && std::isnan(height[2]) && std::isnan(height[3]));
    EXPECT_HAS(notesOf(cloud), "a.csv: *not read: 'tree'");
    EXPECT_HAS(notesOf(cloud), "a.csv: 3 attribute values");
    EXPECT_HAS(notesOf(readText("b.csv", "x,y,z\n1,2,3,4\n")), "columns from 4 *name");
}

TEST_F(XyzTest, NationalGridKeepsMillimetres) {
    const Cloud cloud = readText("a.xyz", "500000.001 4500000.002 170.003\n500100.999 4500100.998 171.997\n");
    EXPECT_EQ(cloud.origin, Vec3d(500000, 4500000, 170));
    EXPECT_LT((world(cloud, 0) - Vec3d(500000.001, 4500000.002, 170.003)).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_LT((world(cloud, 1) - Vec3d(500100.999, 4500100.998, 171.997)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(XyzTest, AFirstPointWithoutDataDoesNotRoundTheOthers) {
    for (const char* first : {"0 0 0\n", "0 0 0\n0 0 0\n", "-1e20 1e20 0\n", "-9999 -9999 -9999\n"})
        for (const int count : {5, 1000}) {
            std::string text = first;
            for (int i = 0; i < count; ++i)
                text += fmt::format("{} {} 170.003\n", 500000.001 + i % 7, 4500000.002 + i % 9);
            const Cloud cloud = readText("a.xyz", text);
            const std::size_t at = cloud.positions.size() - static_cast<std::size_t>(count);
            EXPECT_LT((world(cloud, at) - Vec3d(500000.001, 4500000.002, 170.003)).cwiseAbs().maxCoeff(), 1e-5) << text;
            EXPECT_EQ(cloud.origin[2], 170);
        }
    // Otherwise the first point stays the origin; two points cannot decide.
    EXPECT_EQ(readText("b.xyz", "900 0 0\n1 2 3\n2 3 4\n3 2 1\n").origin, Vec3d(900, 0, 0));
    EXPECT_EQ(readText("c.xyz", "0 0 0\n1e9 0 0\n").origin, Vec3d(0, 0, 0));
    EXPECT_EQ(readText("d.xyz", "9e6 5 5\n0 0 0\n0 0 0\n0 0 0\n9e6 6 5\n9e6 5 6\n9e6 6 6\n").origin, Vec3d(9e6, 5, 5));
}

TEST_F(XyzTest, OriginIsIntegerAndKeepsSmallCoordinates) {
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
    EXPECT_HAS(reasonOfText("a.txt", "Dear reader,\nthis is prose.\n"), "a.txt:1: *neither");
    EXPECT_HAS(reasonOfText("a.xyz", "1 2 3\n4 5\n"), "a.xyz:2: *2 columns*3");
    EXPECT_HAS(reasonOfText("a.xyz", "1 2 3\n4 five 6\n"), "a.xyz:2: column 2 *'five'");
    EXPECT_HAS(reasonOfText("a.csv", "1,5\n"), "a.csv:1: *neither");
    EXPECT_HAS(reasonOfText("a.pts", "3\n1 2 3\n4 5 6\n"), "truncated: *2 of 3 ");
    EXPECT_HAS(reasonOfText("a.xyz", "# nothing\n"), "no points");
    EXPECT_HAS(reasonOfText("a.xyz", "2\n1\n0 0 0\n1 0 0\n"), "a.xyz:2: *second count");
}

TEST_F(XyzTest, EveryPrefixIsReadOrRefused) {
    readPrefixes("a.csv", "\"x\",\"y\",\"z\",r,g,b\n1,2,3,4,5,6\n\"1\",2,3,4,5,6\n");
    readPrefixes("a.pts", "2\n1 2 3 -4 5 6 7\n1 2 3 4 5 6 7\n");
}

} // namespace
} // namespace pointrt
