// SPDX-License-Identifier: Apache-2.0
#include "tests/preprocess/input/input_fixture.h"

#include <bit>

namespace pointrt {
namespace {

using PcdTest = InputTest;

const std::string kFields =
    "# .PCD v0.7\nVERSION 0.7\nFIELDS x _ y z rgb normal_x normal_y normal_z\nSIZE 8 1 4 2 4 4 4 4\n"
    "TYPE F U F I F F F F\nCOUNT 1 3 1 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";

struct Point {
    double x;
    float y;
    short z;
    std::uint32_t rgb;
    Vec3f normal;
};

const std::vector<Point> kPoints = {{0.1, 2.5f, -3, 0x00ff8001, {0, 0, 1}}, {7.0, 1.25f, 12, 0x00010203, {1, 0, 0}}};

std::string asciiPcd() {
    std::string text = kFields + "DATA ascii\n";
    for (const Point& p : kPoints)
        text +=
            fmt::format("{} 1 2 3 {} {} {} {} {} {}\n", p.x, p.y, p.z, p.rgb, p.normal[0], p.normal[1], p.normal[2]);
    return text;
}

std::string binaryPcd() {
    std::string text = kFields + "DATA binary\n";
    for (const Point& p : kPoints)
        text += bytesOf(p.x) + "abc" + bytesOf(p.y) + bytesOf(p.z) + bytesOf(p.rgb) + bytesOf(p.normal[0]) +
                bytesOf(p.normal[1]) + bytesOf(p.normal[2]);
    return text;
}

/// LZF data of literal runs only.
std::string packLiterally(const std::string& bytes) {
    std::string packed;
    for (std::size_t at = 0; at < bytes.size(); at += 32) {
        const std::string run = bytes.substr(at, 32);
        packed += static_cast<char>(run.size() - 1) + run;
    }
    return packed;
}

std::string compressed(const std::string& header, const std::string& packed, std::size_t size) {
    return header + "DATA binary_compressed\n" + bytesOf(static_cast<std::uint32_t>(packed.size())) +
           bytesOf(static_cast<std::uint32_t>(size)) + packed;
}

std::string compressedPcd() {
    std::string columns[8];
    for (const Point& p : kPoints) {
        columns[0] += bytesOf(p.x);
        columns[1] += "abc";
        columns[2] += bytesOf(p.y);
        columns[3] += bytesOf(p.z);
        columns[4] += bytesOf(p.rgb);
        for (int axis = 0; axis < 3; ++axis) columns[5 + axis] += bytesOf(p.normal[axis]);
    }
    std::string bytes;
    for (const std::string& column : columns) bytes += column;
    return compressed(kFields, packLiterally(bytes), bytes.size());
}

void expectPoints(const Cloud& cloud) {
    ASSERT_EQ(cloud.positions.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const Point& p = kPoints[i];
        EXPECT_LT((world(cloud, i) - Vec3d(p.x, p.y, p.z)).norm(), 1e-6);
        EXPECT_EQ(cloud.normals[i], p.normal);
        EXPECT_EQ(cloud.colors[i], (Rgb8{static_cast<std::uint8_t>(p.rgb >> 16), static_cast<std::uint8_t>(p.rgb >> 8),
                                         static_cast<std::uint8_t>(p.rgb)}));
    }
    EXPECT_TRUE(cloud.sensors.empty());
}

TEST_F(PcdTest, AllEncodingsGiveTheSameCloud) {
    expectPoints(readText("a.pcd", asciiPcd()));
    expectPoints(readText("b.pcd", binaryPcd()));
    expectPoints(readText("c.pcd", compressedPcd()));
}

TEST_F(PcdTest, EveryPrefixIsRefusedCleanly) {
    readPrefixes("a.pcd", asciiPcd());
    readPrefixes("b.pcd", binaryPcd());
    readPrefixes("c.pcd", compressedPcd());
}

std::string simple(const std::string& shape, const std::string& body) {
    return "VERSION .5\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n" + shape + "DATA ascii\n" + body;
}

TEST_F(PcdTest, BackReferences) {
    // 12 zero bytes: one literal, then 11 more copied from one byte back.
    const std::string packed = std::string("\x00\x00", 2) + std::string("\xe0\x02\x00", 3);
    const std::string header = "VERSION 0.7\nFIELDS x y z\nWIDTH 1\nHEIGHT 1\n";
    EXPECT_EQ(world(readText("c.pcd", compressed(header, packed, 12)), 0), Vec3d(0, 0, 0));
    EXPECT_HAS(reasonOfText("c.pcd", compressed(header, std::string("\x00\x00\xe0\x02\x01", 5), 12)), "invalid");
    EXPECT_HAS(reasonOfText("c.pcd", compressed(header, std::string("\x00\x00\xe0\x03\x00", 5), 12)), "invalid");
    EXPECT_HAS(reasonOfText("c.pcd", compressed(header, std::string("\x05\x00", 2), 12)), "invalid");
    EXPECT_HAS(reasonOfText("c.pcd", compressed("VERSION 0.7\nFIELDS x y z\nWIDTH 300000000\n", packed, 3600000000u)),
               "invalid");
}

TEST_F(PcdTest, PackedColorsInText) {
    const auto color = [&](const char* type, const std::string& value) {
        return readText(
                   "a.pcd",
                   fmt::format("VERSION .7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F {}\nCOUNT 1 1 1 1\nWIDTH 1\n"
                               "HEIGHT 1\nDATA ascii\n0 0 0 {}\n",
                               type, value))
            .colors[0];
    };
    const Rgb8 wanted = {1, 2, 3};
    EXPECT_EQ(color("U", "66051"), wanted);
    EXPECT_EQ(color("F", fmt::format("{:.9e}", std::bit_cast<float>(0x010203u))), wanted);
    EXPECT_EQ(color("F", "66051"), wanted);
    EXPECT_EQ(color("I", "-16711165"), (Rgb8{1, 2, 3}));
}

TEST_F(PcdTest, OrganisedCloudsHaveASensor) {
    const Cloud cloud =
        readText("a.pcd", simple("WIDTH 1\nHEIGHT 2\nVIEWPOINT 1 2 3 1 0 0 0\n", "10 20 30\nnan nan nan\n"));
    EXPECT_EQ(cloud.points_non_finite, 1u);
    ASSERT_EQ(cloud.sensors.size(), 1u);
    EXPECT_EQ(cloud.origin + cloud.sensors[0].cast<double>(), Vec3d(1, 2, 3));
    EXPECT_EQ(cloud.sensor_of_point, std::vector<std::uint32_t>{0});
    EXPECT_EQ(readText("b.pcd", simple("WIDTH 1\nHEIGHT 2\n", "1 2 3\n1 2 3\n")).sensors.size(), 1u);
    EXPECT_EQ(
        readText("c.pcd", simple("WIDTH 2\nHEIGHT 1\nVIEWPOINT 0 0 -2 1 0 0 0\n", "1 2 3\n1 2 3\n")).sensors.size(),
        1u);
    EXPECT_TRUE(readText("d.pcd", simple("WIDTH 2\nHEIGHT 1\n", "1 2 3\n1 2 3\n")).sensor_of_point.empty());
}

TEST_F(PcdTest, FieldsAreAttributes) {
    const std::string head =
        "VERSION .7\nFIELDS x y z Intensity label v _ fpfh\nSIZE 4 4 4 4 1 2 4 4\nTYPE F F F F U I F F\n"
        "COUNT 1 1 1 1 1 2 1 5\nWIDTH 2\nHEIGHT 1\n";
    const std::string rows = "1 2 3 0.5 7 -1 300 9 1 2 3 4 5\n4 5 6 0.25 300 5 6 9 1 2 3 4 5\n";
    std::string packed[8], bytes;
    for (int i = 0; i < 2; ++i) {
        const float position[] = {i == 0 ? 1.f : 4.f, i == 0 ? 2.f : 5.f, i == 0 ? 3.f : 6.f};
        std::string point[8] = {
            bytesOf(position[0]),
            bytesOf(position[1]),
            bytesOf(position[2]),
            bytesOf(i == 0 ? 0.5f : 0.25f),
            i == 0 ? "\7" : "\xff",
            i == 0 ? bytesOf(short{-1}) + bytesOf(short{300}) : bytesOf(short{5}) + bytesOf(short{6}),
            std::string(4, '\1'),
            std::string(20, '\2')};
        for (int field = 0; field < 8; ++field) packed[field] += point[field], bytes += point[field];
    }
    std::string columns;
    for (const std::string& column : packed) columns += column;
    for (const std::string& text : {head + "DATA ascii\n" + rows, head + "DATA binary\n" + bytes,
                                    compressed(head, packLiterally(columns), columns.size())}) {
        const Cloud cloud = readText("a.pcd", text);
        EXPECT_EQ(attributeNames(cloud), (Names{"intensity", "label", "v"}));
        EXPECT_EQ(numbersOf(cloud, "intensity"), (Numbers{0.5, 0.25}));
        EXPECT_EQ(numbersOf(cloud, "label"), (Numbers{7, 255}));
        EXPECT_EQ(attributeOf(cloud, "v").components, 2u);
        EXPECT_EQ(attributeOf(cloud, "v").type, Scalar::kI16);
        EXPECT_EQ(numbersOf(cloud, "v"), (Numbers{-1, 300, 5, 6}));
        EXPECT_HAS(notesOf(cloud), "not read: 'fpfh'");
    }
    EXPECT_HAS(notesOf(readText("a.pcd", head + "DATA ascii\n" + rows)), "outside *declared types");
}

TEST_F(PcdTest, BadFilesSayWhy) {
    EXPECT_HAS(reasonOfText("a.pcd", "1 2 3\n"), "header");
    EXPECT_HAS(reasonOfText("a.pcd", simple("", "1 2 3\n")), "WIDTH *POINTS");
    EXPECT_HAS(reasonOfText("a.pcd", simple("WIDTH 2\nHEIGHT 2\nPOINTS 5\n", "1 2 3\n")), "differs from POINTS 5");
    EXPECT_HAS(reasonOfText("a.pcd", simple("WIDTH 99999999999\nHEIGHT 1\n", "1 2 3\n")),
               "promises 99999999999 points");
    EXPECT_HAS(reasonOfText("a.pcd", simple("WIDTH 9999999999999\nHEIGHT 99999999999\n", "1 2 3\n")),
               "differs from POINTS");
    EXPECT_HAS(reasonOfText("a.pcd", simple("WIDTH 2\n", "1.25 2.25 3.25\n")), "truncated: *1 of 2 ");
    EXPECT_HAS(reasonOfText("a.pcd", simple("WIDTH 1\n", "1 x 3\n")), "a.pcd:8: 'x' *number");
    EXPECT_HAS(reasonOfText("a.pcd", "VERSION .7\nFIELDS x y z\nSIZE 4 4\nDATA ascii\n"), "a.pcd:3: SIZE *fewer");
    EXPECT_HAS(reasonOfText("a.pcd", "VERSION .7\nFIELDS x y z\nSIZE 4 4 3\nWIDTH 1\nDATA ascii\n1 2 3\n"),
               "type *3 bytes");
    EXPECT_HAS(reasonOfText("a.pcd", "VERSION .7\nFIELDS x y z\nCOUNT 1 1 99999999\nWIDTH 1\nDATA ascii\n1 2 3\n"),
               "impossible COUNT");
    EXPECT_HAS(reasonOfText("a.pcd", "VERSION .7\nFIELDS x y\nWIDTH 1\nDATA ascii\n1 2\n"), "FIELDS *x, y and z");
    EXPECT_HAS(reasonOfText("a.pcd", "VERSION .7\nFIELDS x y z\nWIDTH 1\nDATA zipped\n"), "DATA 'zipped'");
    EXPECT_HAS(reasonOfText("a.pcd", binaryPcd().substr(0, binaryPcd().size() - 1)), "truncated: *1 of 2 ");
}

} // namespace
} // namespace pointrt
