// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/input_fixture.h"

namespace pointrt {
namespace {

using PlyTest = InputTest;

const std::string kVertexHeader =
    "element vertex 3\n"
    "property uchar red\nproperty list uchar short tags\nproperty double x\nproperty float y\n"
    "property short z\nproperty uchar green\nproperty float nx\nproperty float ny\n"
    "property float nz\nproperty uchar blue\nproperty uint label\n";
const std::string kFaceHeader = "element face 1\nproperty uchar flag\nproperty list uchar int vertex_indices\n"
                                "property list int float texcoord\n";

struct Vertex {
    std::uint8_t red;
    std::vector<short> tags;
    double x;
    float y;
    short z;
    std::uint8_t green;
    float nx, ny, nz;
    std::uint8_t blue;
    std::uint32_t label;
};

const std::vector<Vertex> kVertices = {{255, {}, 0.125, 1.5f, -3, 10, 0, 0, 1, 20, 7},
                                       {0, {1, -2}, 1e-3, 2.5f, 4, 11, 0, 1, 0, 21, 8},
                                       {1, {9}, -7.75, 0.25f, 300, 12, -1, 0, 0, 22, 9}};

std::string asciiPly() {
    std::string text = "ply\nformat ascii 1.0\ncomment hello\n" + kVertexHeader + kFaceHeader + "end_header\n";
    for (const Vertex& v : kVertices) {
        text += fmt::format("{} {}", v.red, v.tags.size());
        for (const short tag : v.tags) text += fmt::format(" {}", tag);
        text += fmt::format(" {} {} {} {} {} {} {} {} {}\n", v.x, v.y, v.z, v.green, v.nx, v.ny, v.nz, v.blue, v.label);
    }
    return text + "5 3 2 1 0 2 0.5 0.25\n";
}

std::string binaryPly(bool big) {
    std::string text = fmt::format("ply\nformat binary_{}_endian 1.0\n", big ? "big" : "little") + kVertexHeader +
                       kFaceHeader + "end_header\n";
    const auto add = [&](auto value) { text += bytesOf(value, big); };
    for (const Vertex& v : kVertices) {
        add(v.red);
        add(static_cast<std::uint8_t>(v.tags.size()));
        for (const short tag : v.tags) add(tag);
        add(v.x), add(v.y), add(v.z), add(v.green), add(v.nx), add(v.ny), add(v.nz), add(v.blue), add(v.label);
    }
    add(std::uint8_t{5}), add(std::uint8_t{3}), add(2), add(1), add(0), add(2), add(0.5f), add(0.25f);
    return text;
}

void expectVertices(const Cloud& cloud) {
    ASSERT_EQ(cloud.positions.size(), 3u);
    ASSERT_EQ(cloud.normals.size(), 3u);
    ASSERT_EQ(cloud.colors.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vertex& v = kVertices[i];
        EXPECT_EQ(world(cloud, i), Vec3d(v.x, v.y, v.z).cast<float>().cast<double>());
        EXPECT_EQ(cloud.normals[i], Vec3f(v.nx, v.ny, v.nz));
        EXPECT_EQ(cloud.colors[i], (Rgb8{v.red, v.green, v.blue}));
    }
    ASSERT_EQ(cloud.triangles.size(), 1u);
    EXPECT_EQ(cloud.triangles[0], (std::array<std::uint32_t, 3>{2, 1, 0}));
    EXPECT_EQ(attributeNames(cloud), Names{"label"});
    EXPECT_EQ(attributeOf(cloud, "label").type, Scalar::kU32);
    EXPECT_EQ(numbersOf(cloud, "label"), (Numbers{7, 8, 9}));
    EXPECT_HAS(notesOf(cloud), "not read: 'tags'");
}

TEST_F(PlyTest, AllEncodingsGiveTheSameCloud) {
    expectVertices(readText("a.ply", asciiPly()));
    expectVertices(readText("l.ply", binaryPly(false)));
    expectVertices(readText("b.ply", binaryPly(true)));
}

TEST_F(PlyTest, EveryPrefixIsRefusedCleanly) {
    readPrefixes("a.ply", asciiPly());
    readPrefixes("l.ply", binaryPly(false));
    readPrefixes("b.ply", binaryPly(true));
}

std::string ascii(const std::string& properties, const std::string& body, int count = 1) {
    return fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float "
                       "z\n{}end_header\n{}",
                       count, properties, body);
}

TEST_F(PlyTest, HeaderOddities) {
    const std::string odd =
        "ply \r\nformat ascii 1.0 \r\nobj_info num_cols 4\r\nbye\r\nbye\r\ncomment x\r\nelement vertex 1  \r\n"
        "property float x \r\nproperty float y\r\nproperty float z\r\nelement range_grid 3\r\n"
        "property list uchar int vertex_indices\r\nend_header\r\n1 2 3 \r\n0\r\n1 0\r\n0\r\n";
    EXPECT_EQ(world(readText("a.ply", odd), 0), Vec3d(1, 2, 3));
    std::string mac = ascii("", "1 2 3\r");
    std::replace(mac.begin(), mac.end(), '\n', '\r');
    EXPECT_EQ(world(readText("m.ply", mac), 0), Vec3d(1, 2, 3));
}

TEST_F(PlyTest, ElementsWithoutPropertiesTakeNoTime) {
    for (const char* name : {"face", "tristrips", "range_grid", "other"}) {
        const std::string element = fmt::format("element {} 12223222222222222\n", name);
        EXPECT_EQ(readText("a.ply", ascii(element, "1 2 3\n")).positions.size(), 1u) << name;
    }
}

TEST_F(PlyTest, BinaryBodyAfterCarriageReturn) {
    const std::string body = bytesOf(1.f) + bytesOf(2.f) + bytesOf(3.f);
    const std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        "property float z\nend_header";
    EXPECT_EQ(world(readText("a.ply", header + "\r\n" + body), 0), Vec3d(1, 2, 3));
    EXPECT_EQ(world(readText("b.ply", header + "\n" + body), 0), Vec3d(1, 2, 3));
}

TEST_F(PlyTest, ColorScales) {
    const auto colors = [&](const char* type, const char* values) {
        const std::string properties = fmt::format("property {0} r\nproperty {0} g\nproperty {0} b\n", type);
        return readText("c.ply", ascii(properties, fmt::format("0 0 0 {}\n", values))).colors[0];
    };
    EXPECT_EQ(colors("uchar", "1 2 255"), (Rgb8{1, 2, 255}));
    EXPECT_EQ(colors("float", "0 0.5 1"), (Rgb8{0, 128, 255}));
    EXPECT_EQ(colors("float", "0 128 255"), (Rgb8{0, 128, 255}));
    EXPECT_EQ(colors("ushort", "0 1 255"), (Rgb8{0, 1, 255}));
    EXPECT_EQ(colors("ushort", "255 256 65535"), (Rgb8{0, 1, 255}));
    EXPECT_EQ(colors("float", "nan -1 0.5"), (Rgb8{0, 0, 128}));
}

TEST_F(PlyTest, SplatColors) {
    const std::string properties = "property float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\n";
    EXPECT_EQ(readText("s.ply", ascii(properties, "0 0 0 0 9 -9\n")).colors[0], (Rgb8{128, 255, 0}));
}

TEST_F(PlyTest, PropertiesAreAttributesByTheNamesThatToolsWrite) {
    const Cloud cloud = readText(
        "a.ply",
        ascii("property uchar scalar_Classification\nproperty float scalar_Intensity\nproperty double GpsTime\n"
              "property float confidence\nproperty short scan\nproperty float s\nproperty uchar alpha\n"
              "property float radius\nproperty float Intensity\nproperty float Intensity\n",
              "1 2 3 6 0.5 413665.23368423499 0.25 -3 0.75 255 2 9 8\n"));
    EXPECT_EQ(attributeNames(cloud), (Names{"classification", "intensity", "gps_time", "confidence", "scan", "s",
                                            "alpha", "radius", "Intensity"}));
    EXPECT_EQ(attributeOf(cloud, "scan").type, Scalar::kI16);
    EXPECT_EQ(numbersOf(cloud, "scan"), Numbers{-3});
    EXPECT_EQ(numbersOf(cloud, "gps_time"), Numbers{413665.23368423499});
    EXPECT_EQ(numbersOf(cloud, "Intensity"), Numbers{9});
    EXPECT_TRUE(cloud.radii.empty()); // without normals
    EXPECT_HAS(notesOf(cloud), "not read: 'Intensity'");
}

TEST_F(PlyTest, BigIntegersKeepAllBits) {
    for (const bool big : {false, true}) {
        const std::string header =
            fmt::format("ply\nformat binary_{}_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                        "property float z\nproperty uint64 id\nproperty int8 t\nend_header\n",
                        big ? "big" : "little");
        const std::uint64_t id = 0xfedcba9876543211u;
        const Cloud cloud = readText("a.ply", header + bytesOf(1.f, big) + bytesOf(2.f, big) + bytesOf(3.f, big) +
                                                  bytesOf(id, big) + "\x85");
        const Attribute attribute = attributeOf(cloud, "id");
        EXPECT_EQ(std::string(attribute.values.begin(), attribute.values.end()), bytesOf(id));
        EXPECT_EQ(numbersOf(cloud, "t"), Numbers{-123});
    }
    const Cloud text = readText("t.ply", ascii("property uint64 id\n", "1 2 3 18364758544493064721\n"));
    EXPECT_EQ(std::string(text.attributes[0].values.data(), 8), bytesOf(std::uint64_t{18364758544493064721u}));
}

TEST_F(PlyTest, NumbersOutsideTheirTypesAreNoted) {
    const Cloud cloud =
        readText("a.ply", ascii("property uchar a\nproperty char b\nproperty int c\n", "1 2 3 300 -300 2.75\n"));
    EXPECT_EQ(numbersOf(cloud, "a"), Numbers{255});
    EXPECT_EQ(numbersOf(cloud, "b"), Numbers{-128});
    EXPECT_EQ(numbersOf(cloud, "c"), Numbers{3});
    EXPECT_HAS(notesOf(cloud), "outside *declared types");
    EXPECT_EQ(notesOf(readText("b.ply", ascii("property uchar a\n", "1 2 3 +7\n"))), "");
}

TEST_F(PlyTest, RestsThatTheHeaderDoesNotDescribeAreNoted) {
    const Cloud text = readText("a.ply", ascii("", "1 2 3\n\n4 5 6\n7 8 9\n"));
    EXPECT_EQ(text.positions.size(), 1u);
    EXPECT_HAS(notesOf(text), "promises 1 vertices*2 more lines");
    EXPECT_EQ(notesOf(readText("b.ply", ascii("", "1 2 3\n \r\n"))), "") << "blank lines";
    EXPECT_HAS(notesOf(readText("c.ply", binaryPly(false) + "12345")), "5 more bytes");
}

TEST_F(PlyTest, SixteenBitColorsAreKept) {
    const Cloud cloud = readText(
        "a.ply", ascii("property ushort blue\nproperty ushort red\nproperty ushort green\n", "1 2 3 65535 257 0\n"));
    EXPECT_EQ(cloud.colors[0], (Rgb8{1, 0, 255}));
    EXPECT_EQ(attributeOf(cloud, "rgb16").components, 3u);
    EXPECT_EQ(numbersOf(cloud, "rgb16"), (Numbers{257, 0, 65535}));
}

TEST_F(PlyTest, SixteenBitColorsAsExported) {
    const Cloud cloud = readText(
        "a.ply", ascii("property uchar red\nproperty uchar green\nproperty uchar blue\nproperty ushort rgb16_0\n"
                       "property ushort rgb16_1\nproperty ushort rgb16_2\n",
                       "1 2 3 9 8 7 2304 2048 65535\n"));
    EXPECT_EQ(cloud.colors[0], (Rgb8{9, 8, 7}));
    EXPECT_EQ(attributeNames(cloud), Names{"rgb16"});
    EXPECT_EQ(numbersOf(cloud, "rgb16"), (Numbers{2304, 2048, 65535}));
}

TEST_F(PlyTest, DiscsHaveRadii) {
    const std::string discs = "property float nx\nproperty float ny\nproperty float nz\nproperty float radius\n";
    const Cloud cloud = readText("a.ply", ascii(discs, "1 2 3 0 0 1 0.5\n1 2 4 0 0 1 0\n1 2 5 0 0 1 -1\n", 3));
    EXPECT_EQ(cloud.radii, (std::vector<float>{0.5f, 0, 0}));
    EXPECT_TRUE(cloud.attributes.empty());
    EXPECT_TRUE(cloud.normal_sides);
    // radii in a mesh are not those of discs
    const std::string mesh = discs + "element face 1\nproperty list uchar int vertex_indices\n";
    EXPECT_TRUE(
        readText("m.ply", ascii(mesh, "0 0 0 0 0 1 5\n1 0 0 0 0 1 5\n0 1 0 0 0 1 5\n3 0 1 2\n", 3)).radii.empty());
}

TEST_F(PlyTest, TextureCoordinatesOfMeshesAreSkipped) {
    const std::string uv = "property float s\nproperty float t\n";
    const std::string mesh = uv + "element face 1\nproperty list uchar int vertex_indices\n";
    const Cloud cloud = readText("m.ply", ascii(mesh, "0 0 0 1 2\n1 0 0 1 2\n0 1 0 1 2\n3 0 1 2\n", 3));
    EXPECT_TRUE(cloud.attributes.empty());
    EXPECT_EQ(notesOf(cloud).find("not read"), std::string::npos);
    EXPECT_EQ(attributeNames(readText("p.ply", ascii(uv, "0 0 0 1 2\n"))), (Names{"s", "t"}));
}

TEST_F(PlyTest, PolygonsAndStrips) {
    const std::string four = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const std::string quad = "element face 1\nproperty list uchar int vertex_index\n";
    using Faces = std::vector<std::array<std::uint32_t, 3>>;
    EXPECT_EQ(readText("q.ply", ascii(quad, four + "4 0 1 2 3\n", 4)).triangles, (Faces{{0, 1, 2}, {0, 2, 3}}));
    const std::string strip = "element tristrips 1\nproperty list int int vertex_indices\n";
    EXPECT_EQ(readText("s.ply", ascii(strip, four + "8 0 1 3 2 -1 1 2 3\n", 4)).triangles,
              (Faces{{0, 1, 3}, {3, 1, 2}, {1, 2, 3}}));
}

TEST_F(PlyTest, FacesBeforeVertices) {
    const std::string text =
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_EQ(readText("f.ply", text).triangles.size(), 1u);
}

TEST_F(PlyTest, NonFinitePointsRemoveTheirFaces) {
    const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n";
    const std::string body = "0 0 0\nnan 0 0\n1 0 0\n0 1 0\n1e39 0 0\n3 0 1 2\n3 0 2 3\n";
    const Cloud cloud = readText("n.ply", ascii(faces, body, 5));
    EXPECT_EQ(cloud.points_read, 5u);
    EXPECT_EQ(cloud.points_non_finite, 2u);
    EXPECT_EQ(cloud.positions.size(), 3u);
    ASSERT_EQ(cloud.triangles.size(), 1u);
    EXPECT_EQ(cloud.triangles[0], (std::array<std::uint32_t, 3>{0, 1, 2}));
}

TEST_F(PlyTest, BadFilesSayWhy) {
    EXPECT_HAS(reasonOfText("a.ply", "plx\n"), "a.ply: *'ply'");
    EXPECT_HAS(reasonOfText("a.ply", "ply\nformat ascii 1.0\n"), "end_header");
    EXPECT_HAS(reasonOfText("a.ply", "ply\nelement vertex 1\nend_header\n"), "no format");
    EXPECT_HAS(reasonOfText("a.ply", "ply\nformat binary_middle 1.0\nend_header\n"), "a.ply:2: *format");
    EXPECT_HAS(reasonOfText("a.ply", "ply\nformat ascii 1.0\nend_header\n"), "no vertex element");
    EXPECT_HAS(reasonOfText("a.ply", "ply\nformat ascii 1.0\nelement vertex x\nend_header\n"),
               "a.ply:3: *'vertex' *count");
    EXPECT_HAS(reasonOfText("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
               "no x, y and z");
    EXPECT_HAS(reasonOfText("a.ply", ascii("", "1 2 three\n")), "a.ply:8: 'three' *number");
    EXPECT_HAS(reasonOfText("a.ply", ascii("", "", 0)), "no points");
    EXPECT_HAS(reasonOfText("a.ply", ascii("", "nan 1 1\n")), "none of its 1 *finite");
    EXPECT_HAS(reasonOfText("a.ply", ascii("", "1 1 1\n2 2 2\n3 3 3 \n", 4)), "only 19 bytes");
    EXPECT_HAS(reasonOfText("a.ply", ascii("", "1.5 1.5 1.5\n2 2 2\n", 3)), "truncated: *2 of 3 ");
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    EXPECT_HAS(reasonOfText("a.ply", ascii(face, "1 1 1\n3 0 0 1\n")), "face 0: vertex index 1 ");
    EXPECT_HAS(reasonOfText("a.ply", ascii(face, "1 1 1\n3 0 0 -1\n")), "face 0: vertex index -1 ");
    EXPECT_HAS(reasonOfText("a.ply", ascii(face, "1 1 1\n-3 0 0 0\n")), "list length -3");
}

TEST_F(PlyTest, TruncatedBinaryFilesReportTheCount) {
    std::string text =
        "ply\nformat binary_big_endian 1.0\nelement vertex 10\nproperty float x\nproperty float y\nproperty float z\n"
        "end_header\n";
    text += std::string(7 * 12 + 5, '\0');
    EXPECT_HAS(reasonOfText("a.ply", text), "truncated: *7 of 10 ");
}

TEST_F(PlyTest, CountsAreCheckedBeforeAllocation) {
    for (const char* format : {"ascii", "binary_little_endian"}) {
        for (const char* count : {"4000000000", "18446744073709551615"}) {
            const std::string text =
                fmt::format("ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
                            "property float z\nend_header\n1 2 3\n",
                            format, count);
            EXPECT_HAS(reasonOfText("a.ply", text), count);
        }
    }
}

} // namespace
} // namespace pointrt
