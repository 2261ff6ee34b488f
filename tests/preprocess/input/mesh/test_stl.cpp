// SPDX-License-Identifier: Apache-2.0
// STL meshes, text and binary.
#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using StlTest = InputTest;

std::string facet(const std::vector<float>& corners, std::uint16_t color = 0) {
    std::string bytes(12, '\0'); // the normal
    for (const float value : corners) bytes += bytesOf(value);
    return bytes + bytesOf(color);
}

std::string stl(const std::vector<std::string>& facets, std::string header = "made by a test") {
    header.resize(80, ' ');
    std::string bytes = header + bytesOf(std::uint32_t(facets.size()));
    for (const std::string& each : facets) bytes += each;
    return bytes;
}

const std::vector<float> kLeft = {0, 0, 0, 1, 0, 0, 0, 1, 0}, kRight = {1, 0, 0, 1, 1, 0, -0.f, 1, 0};
const std::string kText =
    "solid square\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n"
    "  endloop\n endfacet\n FACET NORMAL 0 0 1\n  outer loop\n   VERTEX 1 0 0\n   vertex 1 1 0\n"
    "   vertex 0 1 0\n  endloop\n endfacet\nendsolid square\n";

/// The vertices of the mesh, without points sampled on it.
void expectSquare(const Cloud& cloud) {
    ASSERT_EQ(cloud.positions.size(), 4u); // two are shared
    ASSERT_EQ(cloud.triangles.size(), 2u);
    EXPECT_EQ(cloud.triangles[1], (std::array<std::uint32_t, 3>{1, 3, 2}));
    EXPECT_EQ(world(cloud, 3), Vec3d(1, 1, 0));
}

TEST_F(StlTest, TrianglesShareVertices) {
    expectSquare(readText("a.stl", stl({facet(kLeft), facet(kRight)})));
    expectSquare(readText("b.stl", kText));
    expectSquare(readText("c.stl", stl({facet(kLeft), facet(kRight)}, "solid in spite of being binary")));
}

TEST_F(StlTest, ColoursOfFacets) {
    constexpr std::uint16_t kRed = 31 << 10, kBlue = 31, kValid = 1 << 15;
    const Cloud viscam = readText("a.stl", stl({facet(kLeft, kRed | kValid)}));
    EXPECT_EQ(viscam.colors.at(0), (Rgb8{255, 0, 0}));
    const Cloud magics = readText("b.stl", stl({facet(kLeft, kBlue)}, "COLOR=abcd,"));
    EXPECT_EQ(magics.colors.at(0), (Rgb8{255, 0, 0}));
    EXPECT_TRUE(readText("c.stl", stl({facet(kLeft, kRed)})).colors.empty());
}

TEST_F(StlTest, MalformedLinesAndCutFiles) {
    EXPECT_HAS(reasonOfText("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"), "a.stl:4");
    EXPECT_HAS(reasonOfText("b.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\n"),
               "b.stl:6");
    EXPECT_HAS(reasonOfText("c.stl", "solid a\nfacet normal 0 0 1\nwords\n"), "words");
    const std::string whole = stl({facet(kLeft), facet(kRight)});
    EXPECT_HAS(reasonOfText("d.stl", whole.substr(0, whole.size() - 1)), "--salvage");
}

TEST_F(StlTest, DamagedFilesAreReadOrRefused) {
    const std::string binary = stl({facet(kLeft), facet(kRight)});
    readPrefixes("a.stl", binary);
    readChangedBytes("a.stl", binary);
    readChangedBytes("b.stl", kText);
    for (std::size_t size = 0; size < kText.size(); ++size) { // the last line may be missing
        try {
            read(write("c.stl", kText.substr(0, size)));
        } catch (const Error& error) {
            ASSERT_EQ(error.code, ExitCode::kBadInput) << error.what();
        }
    }
}

} // namespace
} // namespace pointrt
