// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using ObjTest = InputTest;
using OffTest = InputTest;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const std::string kSquare = "# a square\nmtllib none.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\n";

TEST_F(ObjTest, PolygonsAndReferences) {
    EXPECT_EQ(readText("a.obj", kSquare + "f 1 2 3 4\n").triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(readText("b.obj", kSquare + "f -4 -3 \\\n-2\n").triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(readText("c.obj", kSquare + "vt 0 0\nvn 0 0 2\nf 1/1/1 2//1 3/1/-1 # end\n").normals[1], Vec3f(0, 0, 1));
    EXPECT_EQ(readText("d.obj", kSquare).colors[2], (Rgb8{0, 0, 255}));
}

TEST_F(ObjTest, NormalsPerVertex) {
    const Cloud cloud = readText("a.obj", "v 0 0 0\nvn 0 0 1\nv 1 0 0\nvn 0 1 0\n");
    EXPECT_EQ(cloud.normals, (std::vector<Vec3f>{{0, 0, 1}, {0, 1, 0}}));
    EXPECT_TRUE(readText("b.obj", "v 0 0 0\nvn 0 0 1\nvn 0 1 0\n").normals.empty());
    EXPECT_TRUE(readText("c.obj", "v 0 0 0\nvn 0 0 0\n").normals.empty());
}

TEST_F(ObjTest, PartlyColoredIsGreyElsewhere) {
    const Cloud cloud = readText("a.obj", "v 0 0 0\nv 1 0 0 1 0 0\nv 2 0 0\n");
    EXPECT_EQ(cloud.colors, (std::vector<Rgb8>{{200, 200, 200}, {255, 0, 0}, {200, 200, 200}}));
}

TEST_F(ObjTest, BadFilesSayWhy) {
    EXPECT_HAS(reasonOfText("a.obj", "# nothing here\n"), "no points");
    EXPECT_HAS(reasonOfText("a.obj", "v 1 2\n"), "a.obj:1: *3 numbers");
    EXPECT_HAS(reasonOfText("a.obj", "v 1 2 z\n"), "a.obj:1: 'z' *number");
    EXPECT_HAS(reasonOfText("a.obj", "v 0 0 0\nf 1 1 2\n"), "a.obj:2: vertex index 2 *1");
    EXPECT_HAS(reasonOfText("a.obj", "v 0 0 0\nf 1 1 -2\n"), "a.obj:2: vertex index -2 ");
    EXPECT_HAS(reasonOfText("a.obj", "v 0 0 0\nf 0 1 1\n"), "a.obj:2: vertex index 0 ");
    EXPECT_HAS(reasonOfText("a.obj", "v 0 0 0\nf 1//5 1 1\n"), "a.obj:2: normal index 5 ");
    EXPECT_HAS(reasonOfText("a.obj", "v 0 0 0\nf a b c\n"), "a.obj:2: 'a' *index");
    EXPECT_HAS(reasonOfText("a.obj", "v nan nan nan\n"), "none of its 1 *finite");
}

TEST_F(ObjTest, EveryPrefixIsReadOrRefused) {
    readPrefixes("a.obj", kSquare + "vn 0 0 1\nf 1//1 2//1 3//1 \\\n-1//-1\n");
}

TEST_F(OffTest, Kinds) {
    const Cloud plain =
        readText("a.off", "OFF\n# a comment\n\n4 1 0\n0 0 0\n1 0 0 # here too\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n");
    EXPECT_EQ(plain.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(plain.colors, std::vector<Rgb8>(4, Rgb8{255, 0, 0}));
    EXPECT_EQ(readText("b.off", "COFF 1 0 0\n0 0 0 1 2 255 255\n").colors[0], (Rgb8{1, 2, 255}));
    EXPECT_EQ(readText("c.off", "COFF 1 0 0\n0 0 0 0 0.5 1 1\n").colors[0], (Rgb8{0, 128, 255}));
    EXPECT_EQ(readText("d.off", "NOFF\n1 0 0\n1 2 3 0 0 1\n").normals[0], Vec3f(0, 0, 1));
    const Cloud both = readText("e.off", "CNOFF\n1 0 0\n1 2 3 0 0 1 9 8 7 255\n");
    EXPECT_EQ(both.normals[0], Vec3f(0, 0, 1));
    EXPECT_EQ(both.colors[0], (Rgb8{9, 8, 7}));
}

TEST_F(OffTest, BadFilesSayWhy) {
    EXPECT_HAS(reasonOfText("a.off", "OFF BINARY\n"), "a.off: *binary");
    EXPECT_HAS(reasonOfText("a.off", "4OFF\n1 0 0\n"), "a.off:1: *'4OFF'");
    EXPECT_HAS(reasonOfText("a.off", "OFF\n4000000000 0 0\n0 0 0\n"), "promises 4000000000 vertices");
    EXPECT_HAS(reasonOfText("a.off", "OFF\n2 0 0\n0.5 0.5 0.5\n"), "truncated: *1 of 2 ");
    EXPECT_HAS(reasonOfText("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1\n"), "a.off:4: vertex index 1 *1");
    EXPECT_HAS(reasonOfText("a.off", "OFF\n1 1 0\n0 0 0\n4000000000 0\n"), "a.off:4: '' *index");
    EXPECT_HAS(reasonOfText("a.off", "OFF\n1 0 0\n0 0\n"), "a.off:3: *2 numbers*3");
}

TEST_F(OffTest, EveryPrefixIsReadOrRefused) {
    readPrefixes("a.off", "CNOFF\n2 1 0\n1 2 3 0 0 1 9 8 7 255\n1 2 3 0 0 1 9 8 7 255\n3 0 1 0\n");
}

} // namespace
} // namespace pointrt
