// SPDX-License-Identifier: Apache-2.0
// Points of LAS, LAZ and PLY files, against what they were written from.
#include "format/pointio/point_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "format/base/error.h"
#include "format/pointio/laz.h"
#include "format/pointio/point_sink.h"
#include "tests/support/las_file.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

template <typename Number>
std::vector<Number> numbersOf(const std::vector<std::byte>& values) {
    std::vector<Number> numbers(values.size() / sizeof(Number));
    std::memcpy(numbers.data(), values.data(), values.size());
    return numbers;
}

struct Read {
    PointOutline outline;
    PointBlock points;

    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const PointColumn& column : outline.columns) all.push_back(column.name);
        return all;
    }
    template <typename Number>
    std::vector<Number> column(const std::string& name) const {
        for (std::size_t k = 0; k < outline.columns.size(); ++k)
            if (outline.columns[k].name == name) return numbersOf<Number>(points.columns[k]);
        return {};
    }
};

struct PointReaders : testing::Test {
    test::TemporaryFolder folder;

    /// Reads the file in blocks of two points.
    Read read(const std::string& name) const {
        const std::unique_ptr<PointReader> reader = openPointReader(folder.file(name));
        Read all{reader->outline(), {}};
        all.points.columns.resize(all.outline.columns.size());
        for (PointBlock block; reader->next(block, 2);) {
            EXPECT_LE(block.count(), 2u);
            all.points.positions.insert(all.points.positions.end(), block.positions.begin(), block.positions.end());
            for (std::size_t k = 0; k < block.columns.size(); ++k)
                all.points.columns[k].insert(all.points.columns[k].end(), block.columns[k].begin(),
                                             block.columns[k].end());
        }
        EXPECT_EQ(all.outline.count, all.points.count());
        return all;
    }

    std::string refusal(const std::string& name, const std::string& bytes) const {
        folder.write(name, bytes);
        try {
            read(name);
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kBadInput);
            const std::string text = error.what();
            return text.substr(text.rfind('/') + 1);
        }
        return "";
    }
};

/// Three vertices, one after another, in this byte order.
std::string binaryPly(std::endian order) {
    std::string bytes = "ply\nformat binary_" + std::string(order == std::endian::little ? "little" : "big") +
                        "_endian 1.0\nbye\nelement vertex 3\nproperty double x\nproperty float y\nproperty int z\n"
                        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty short heat\n"
                        "property float nx\nproperty float ny\nproperty float nz\nend_header\n";
    const auto put = [&](auto number) {
        char raw[sizeof number];
        std::memcpy(raw, &number, sizeof number);
        if (order != std::endian::native) std::reverse(std::begin(raw), std::end(raw));
        bytes.append(raw, sizeof raw);
    };
    for (int i = 0; i < 3; ++i) {
        put(500000.125 + i);
        put(2.5f);
        put(std::int32_t{-70000 - i});
        for (const int color : {10, 20, 255}) put(static_cast<std::uint8_t>(color));
        put(static_cast<std::int16_t>(-300 * i));
        put(0.0f);
        put(0.6f);
        put(0.8f);
    }
    return bytes;
}

TEST_F(PointReaders, PlyOfBothOrdersOfBytes) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        folder.write("a.ply", binaryPly(order));
        const Read ply = read("a.ply");
        EXPECT_EQ(ply.names(), (std::vector<std::string>{"normals", "colors", "heat"}));
        EXPECT_EQ(ply.points.positions,
                  (std::vector<double>{500000.125, 2.5, -70000, 500001.125, 2.5, -70001, 500002.125, 2.5, -70002}));
        EXPECT_EQ(ply.column<std::int16_t>("heat"), (std::vector<std::int16_t>{0, -300, -600}));
        EXPECT_EQ(ply.column<std::uint8_t>("colors").at(8), 255);
        EXPECT_EQ(ply.column<float>("normals").at(4), 0.6f);
        EXPECT_EQ(ply.outline.bounds_min, (std::array<double, 3>{500000.125, 2.5, -70002}));
        EXPECT_EQ(ply.outline.bounds_max, (std::array<double, 3>{500002.125, 2.5, -70000}));
    }
}

TEST_F(PointReaders, PlyAsText) {
    folder.write("a.ply", "ply\r\nformat ascii 1.0\r\ncomment c\r\nelement vertex 2\r\nproperty float x\r\n"
                          "property float y\r\nproperty float z\r\nproperty ushort intensity\r\n"
                          "element face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n"
                          "1 +2 3e0 65535\r\n4 5 6\r\n7\r\n3 0 0 1\r\n");
    const Read ply = read("a.ply");
    EXPECT_EQ(ply.points.positions, (std::vector<double>{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(ply.column<std::uint16_t>("intensity"), (std::vector<std::uint16_t>{65535, 7}));
}

TEST_F(PointReaders, MalformedPlyIsOneLine) {
    const std::string start = "ply\nformat ascii 1.0\n", xyz = "property float x\nproperty float y\nproperty float z\n";
    EXPECT_SAYS(refusal("a.ply", start + "element vertex 1\n" + xyz), "a.ply: ends *header");
    EXPECT_SAYS(refusal("a.ply", start + "element vertex 1\nproperty float x\nend_header\n1\n"), "a.ply: *lack y");
    EXPECT_SAYS(refusal("a.ply", start + "end_header\n1\n"), "a.ply: *lack x");
    EXPECT_SAYS(refusal("a.ply", "ply\nelement vertex 1\n" + xyz + "end_header\n1 2 3\n"), "a.ply: *format");
    EXPECT_SAYS(refusal("a.ply", "ply\nformat new 1.0\n"), "a.ply:2: *format");
    EXPECT_SAYS(refusal("a.ply", start + "element vertex many\n"), "a.ply:3: *count");
    EXPECT_SAYS(refusal("a.ply", start + "element camera 1\n"), "a.ply:3: *before*pointrt-bake");
    EXPECT_SAYS(refusal("a.ply", start + "element vertex 1\nproperty list uchar int all\n"),
                "a.ply:4: *lists*pointrt-bake");
    EXPECT_SAYS(refusal("a.ply", start + "element vertex 1\nproperty quad x\n"), "a.ply:4: *type");
    EXPECT_SAYS(refusal("a.ply", start + "element vertex 1\n" + xyz + "property int x\n"), "a.ply:7: *property x");
    EXPECT_SAYS(refusal("a.ply", start + "element vertex 2\n" + xyz + "end_header\n1 2 3\n4 5 six\n"),
                "a.ply:9: \"six\" *float");
    EXPECT_SAYS(refusal("a.ply", start + "element vertex 1\n" + xyz + "property uchar c\nend_header\n1 2 3 256\n"),
                "a.ply:9: \"256\" *uint8");
    EXPECT_SAYS(refusal("a.ply", start + "element vertex 2\n" + xyz + "end_header\n1.25 2.25 3.25\n"),
                "a.ply: ends *vertices");
    EXPECT_SAYS(refusal("a.ply", start + "element vertex 999999999999\n" + xyz + "end_header\n1 2 3\n"),
                "a.ply: promises 999999999999 *1");
    const std::string whole = binaryPly(std::endian::little);
    EXPECT_SAYS(refusal("a.ply", whole.substr(0, whole.size() - 1)), "a.ply: promises 3 *2");
    for (std::size_t bytes = 4; bytes < whole.size(); ++bytes) EXPECT_NE(refusal("a.ply", whole.substr(0, bytes)), "");
}

TEST_F(PointReaders, OurOwnPlyComesBack) {
    PointOutline outline;
    outline.columns = {{"normals", PRO_TYPE_F32, 3, PointRole::kNormal},
                       {"radius", PRO_TYPE_F32, 1, PointRole::kRadius},
                       {"colors", PRO_TYPE_U8, 3, PointRole::kColor},
                       {"gps_time", PRO_TYPE_F64}};
    PointBlock block;
    block.positions = {1e6 + 0.1, 2, 3};
    const auto bytes = [](auto... numbers) {
        const std::array all{numbers...};
        const auto view = std::as_bytes(std::span(all));
        return std::vector<std::byte>(view.begin(), view.end());
    };
    block.columns = {bytes(0.0f, 0.0f, 1.0f), bytes(0.25f), bytes(std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}),
                     bytes(1.0 / 3)};
    const auto sink = openPointSink(folder.file("a.ply"), outline);
    sink->add(block);
    sink->finish();
    const Read ply = read("a.ply");
    EXPECT_EQ(ply.points.positions, block.positions);
    EXPECT_EQ(ply.points.columns, block.columns);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(ply.outline.columns[k].role, outline.columns[k].role);
}

/// Five points of format 3 with a byte of extra bytes each.
std::string fivePoints() {
    test::LasParts parts;
    parts.format = 3;
    parts.offset[0] = 500000;
    parts.records = {test::lasRecord("LASF_Spec", 4, test::extraBytes(1, "wetness"))};
    for (int i = 0; i < 5; ++i)
        parts.points.push_back(test::lasPoint(35, 100 * i, 200, -300, static_cast<std::uint8_t>(i)));
    return parts.bytes();
}

TEST_F(PointReaders, LasWithItsFieldsAndExtraBytes) {
    folder.write("a.las", fivePoints());
    const Read las = read("a.las");
    ASSERT_EQ(las.points.count(), 5u);
    EXPECT_NEAR(las.points.positions[12], 500004, 1e-9);
    EXPECT_NEAR(las.points.positions[14], -3, 1e-9);
    EXPECT_EQ(las.column<std::uint16_t>("intensity").at(1), 0x0201);
    EXPECT_EQ(las.column<std::uint8_t>("classification").at(2), 5);
    EXPECT_EQ(las.column<std::uint8_t>("wetness"), (std::vector<std::uint8_t>{22, 23, 24, 25, 26}));
    EXPECT_EQ(las.column<std::uint16_t>("rgb16").size(), 15u);
}

TEST_F(PointReaders, LasIsWrittenAgainAsItWas) {
    folder.write("a.las", fivePoints());
    const Read first = read("a.las");
    for (const std::string name : {"b.las", "b.laz"}) {
        if (name == "b.laz" && !hasLaz()) continue;
        const auto sink = openPointSink(folder.file(name), first.outline);
        sink->add(first.points);
        sink->finish();
        const Read again = read(name);
        EXPECT_EQ(again.names(), first.names());
        EXPECT_EQ(again.points.positions, first.points.positions);
        EXPECT_EQ(again.points.columns, first.points.columns);
    }
}

TEST_F(PointReaders, WhatIsWrongWithLasIsOneLine) {
    const std::string whole = fivePoints();
    EXPECT_SAYS(refusal("a.las", whole.substr(0, 100)), "a.las: ends *header");
    EXPECT_SAYS(refusal("a.las", whole.substr(0, whole.size() - 1)), "a.las: promises 5 *4");
    EXPECT_SAYS(refusal("gone.ply", ""), "gone.ply: *empty");
    folder.write("a.csv", "1 2 3\n");
    EXPECT_EQ(openPointReader(folder.file("a.csv")), nullptr);
}

} // namespace
} // namespace pointrt
