// SPDX-License-Identifier: Apache-2.0
// Points with columns through each writer, and read back.
#include "format/pointio/point_sink.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "format/base/error.h"
#include "format/pointio/e57.h"
#include "format/pointio/las_fields.h"
#include "format/pointio/las_source_header.h"
#include "format/pointio/laz.h"
#include "format/pointio/pro_points.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

struct PointSinks : testing::Test {
    test::TemporaryFolder folder;

    std::string text(const std::string& name) const {
        std::ifstream file(folder.file(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }

    /// Three points of a national grid, in two blocks.
    void write(const std::string& name, const PointOutline& outline, double far_x = 500002.25) const {
        const auto sink = openPointSink(folder.file(name), outline);
        sink->add(block({500000.125, 4500000.5, 100, 500001, 4500001, 101}, {0.5f, 1.5f}, {7, 65535}, {1, 2}));
        sink->add(block({far_x, 4500003, 102}, {2.5f}, {9}, {3}));
        sink->finish();
    }

    static PointBlock block(std::vector<double> positions, std::vector<float> hours, std::vector<std::uint16_t> heat,
                            std::vector<std::uint8_t> returns) {
        PointBlock block;
        block.positions = std::move(positions);
        const auto bytes = [](const auto& numbers) {
            const auto view = std::as_bytes(std::span(numbers));
            return std::vector<std::byte>(view.begin(), view.end());
        };
        block.columns = {bytes(hours), bytes(heat), bytes(returns)};
        return block;
    }

    static PointOutline outline() {
        PointOutline outline;
        outline.columns = {{"sun hours", PRO_TYPE_F32},
                           {"intensity", PRO_TYPE_U16},
                           {"return_number", PRO_TYPE_U8, 1, PointRole::kAttribute, {{1, 3}}}};
        outline.bounds_min = {500000, 4500000, 100};
        outline.bounds_max = {500010, 4500010, 110};
        outline.position_step = 1e-3;
        outline.program = "a test";
        return outline;
    }
};

/// A LAS file read back.
struct ReadLas {
    std::string bytes, records;
    LasFile file;
    std::vector<LasField> fields;

    explicit ReadLas(std::string all) : bytes(std::move(all)), file(openLas(bytes)), fields(lasFields(file)) {
        const LasHeader& header = file.header;
        records.assign(header.point_count * header.record_bytes, '\0');
        if (!header.packed) {
            records = bytes.substr(header.point_offset, records.size());
            return;
        }
        const LazLayout layout = lazLayout(file);
        LazStream(layout, bytes, layout.chunks.at(0)).read(records.data(), header.point_count);
    }

    template <typename Number>
    std::vector<Number> values(const std::string& name) const {
        std::vector<Number> numbers(file.header.point_count);
        for (const LasField& field : fields)
            if (field.name == name && fieldBytes(field) == sizeof(Number)) {
                unpackField(field, records.data(), file.header.record_bytes, numbers.size(),
                            reinterpret_cast<char*>(numbers.data()));
                return numbers;
            }
        return {};
    }

    double position(std::size_t point, std::size_t axis) const {
        std::int32_t whole;
        std::memcpy(&whole, records.data() + point * file.header.record_bytes + 4 * axis, sizeof whole);
        return file.header.offset[axis] + file.header.scale[axis] * whole;
    }
};

TEST_F(PointSinks, PlyHasTheCountThatItCameTo) {
    write("a.ply", outline());
    const std::string ply = text("a.ply"),
                      header = "ply\nformat binary_little_endian 1.0\ncomment ....................\n"
                               "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
                               "property float sun_hours\nproperty ushort intensity\nproperty uchar return_number\n"
                               "end_header\n";
    ASSERT_EQ(ply.substr(0, header.size()), header);
    constexpr std::size_t kRow = 24 + 4 + 2 + 1;
    ASSERT_EQ(ply.size(), header.size() + 3 * kRow);
    double x;
    std::memcpy(&x, ply.data() + header.size(), sizeof x);
    EXPECT_EQ(x, 500000.125);
    float hours;
    std::memcpy(&hours, ply.data() + header.size() + 2 * kRow + 24, sizeof hours);
    EXPECT_EQ(hours, 2.5f);
    EXPECT_EQ(ply.back(), 3);
}

TEST_F(PointSinks, AnyCountKeepsThePlaceOfThePoints) {
    PointOutline many = outline();
    const auto sink = openPointSink(folder.file("a.ply"), many);
    for (int i = 0; i < 1234; ++i) sink->add(block({1, 2, 3}, {1}, {1}, {1}));
    sink->finish();
    const std::string ply = text("a.ply");
    EXPECT_NE(ply.find("comment .................\nelement vertex 1234\n"), std::string::npos);
    EXPECT_EQ(ply.size(), ply.find("end_header\n") + 11 + 1234 * 31);
    many.count = 1;
    const auto known = openPointSink(folder.file("b.ply"), many);
    known->add(block({1, 2, 3}, {1}, {1}, {1}));
    known->finish();
    EXPECT_EQ(text("b.ply").find("comment"), std::string::npos);
}

TEST_F(PointSinks, TextNamesItsColumns) {
    write("a.csv", outline());
    EXPECT_EQ(text("a.csv"), "x,y,z,sun_hours,intensity,return_number\n500000.125,4500000.5,100,0.5,7,1\n"
                             "500001,4500001,101,1.5,65535,2\n500002.25,4500003,102,2.5,9,3\n");
}

TEST_F(PointSinks, PcdHasItsCountTwice) {
    write("a.pcd", outline());
    const std::string pcd = text("a.pcd"),
                      header = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
                               "FIELDS x y z sun_hours intensity return_number\nSIZE 8 8 8 4 2 1\nTYPE F F F F U U\n"
                               "COUNT 1 1 1 1 1 1\nWIDTH 00000000000000000003\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
                               "POINTS 00000000000000000003\nDATA binary\n";
    ASSERT_EQ(pcd.substr(0, header.size()), header);
    constexpr std::size_t kRow = 24 + 4 + 2 + 1;
    ASSERT_EQ(pcd.size(), header.size() + 3 * kRow);
    double x;
    std::memcpy(&x, pcd.data() + header.size() + 2 * kRow, sizeof x);
    EXPECT_EQ(x, 500002.25);
    EXPECT_EQ(pcd.back(), 3);
}

TEST_F(PointSinks, PcdPacksColoursAndTakesFloatsNearTheOrigin) {
    PointOutline near;
    near.columns = {{"color", PRO_TYPE_U8, 3, PointRole::kColor}, {"normal", PRO_TYPE_F32, 3, PointRole::kNormal}};
    near.count = 1;
    near.bounds_max = {10, 10, 10};
    near.position_step = 1e-3;
    const auto sink = openPointSink(folder.file("a.pcd"), near);
    PointBlock one;
    one.positions = {1, 2, 3};
    const float normal[] = {0, 0, 1};
    const auto bytes = std::as_bytes(std::span(normal));
    one.columns = {{std::byte{10}, std::byte{20}, std::byte{30}}, {bytes.begin(), bytes.end()}};
    sink->add(one);
    sink->finish();
    const std::string pcd = text("a.pcd");
    EXPECT_NE(pcd.find("FIELDS x y z rgb normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4 4\nTYPE F F F U F F F\n"),
              std::string::npos);
    EXPECT_NE(pcd.find("WIDTH 1\n"), std::string::npos);
    EXPECT_EQ(pcd.substr(pcd.find("binary\n") + 7 + 12, 4), std::string("\x1e\x14\x0a\0", 4));
}

TEST_F(PointSinks, E57IsReadBack) {
    if (!hasE57()) GTEST_SKIP() << "this build has no Rust: E57 is not tested";
    PointOutline many = outline();
    many.metres_per_unit = 0.5;
    const auto sink = openPointSink(folder.file("a.e57"), many);
    constexpr std::size_t kPoints = 5000; // several packets and pages
    for (std::size_t i = 0; i < kPoints; ++i)
        sink->add(block({double(i), 2, -3}, {float(i)}, {std::uint16_t(i)}, {std::uint8_t(i)}));
    sink->finish();
    const std::string bytes = text("a.e57");
    const E57File file = openE57(bytes);
    ASSERT_EQ(file.scans.size(), 1u);
    const E57Scan& scan = file.scans[0];
    EXPECT_EQ(scan.points, kPoints);
    ASSERT_EQ(scan.columns.size(), 6u);
    EXPECT_EQ(scan.columns[3].name, "pointrt:sun_hours");
    EXPECT_EQ(scan.columns[4].name, "intensity");
    std::vector<double> x(kPoints), y(kPoints), z(kPoints);
    std::vector<float> hours(kPoints);
    std::vector<std::int64_t> heat(kPoints), returns(kPoints);
    E57Points points = e57Points(file, 0);
    std::size_t read = 0;
    for (std::size_t count = 1; count > 0 && read < kPoints; read += count) { // a packet at a time
        void* const columns[] = {&x[read], &y[read], &z[read], &hours[read], &heat[read], &returns[read]};
        count = readE57Points(points, kPoints - read, columns);
    }
    ASSERT_EQ(read, kPoints);
    EXPECT_EQ(x[4321], 2160.5); // metres
    EXPECT_EQ(z[4999], -1.5);
    EXPECT_EQ(hours[4321], 4321.0f);
    EXPECT_EQ(heat[4321], 4321);
    EXPECT_EQ(returns[300], 300 - 256);
}

TEST_F(PointSinks, LasHasFieldsAndExtraBytes) {
    for (const std::string name : {"a.las", "a.laz"}) {
        if (name == "a.laz" && !hasLaz()) continue;
        write(name, outline());
        const ReadLas las(text(name));
        EXPECT_EQ(las.file.header.point_count, 3u);
        EXPECT_EQ(las.file.header.packed, name == "a.laz");
        EXPECT_NEAR(las.position(2, 0), 500002.25, 1e-9);
        EXPECT_NEAR(las.position(0, 0), 500000.125, 5e-4 + 1e-9);
        EXPECT_EQ(las.values<float>("sun hours"), (std::vector<float>{0.5f, 1.5f, 2.5f}));
        EXPECT_EQ(las.values<std::uint16_t>("intensity"), (std::vector<std::uint16_t>{7, 65535, 9}));
        EXPECT_EQ(las.values<std::uint8_t>("return_number"), (std::vector<std::uint8_t>{1, 2, 3}));
        EXPECT_EQ(lasFields(las.file.header.point_format).size() + 1, las.fields.size()) << "one of extra bytes";
    }
}

TEST_F(PointSinks, ASourcesScaleIsTakenOverWhereItIsWanted) {
    PointOutline coarse = outline(), again = outline();
    coarse.position_step = 0.25;
    write("source.las", coarse);
    ReadLas source(text("source.las"));
    ASSERT_EQ(source.file.header.scale[0], 0.1);
    again.metadata = "{\"source_header\":" + lasSourceHeader(source.file, false) + "}";
    write("same.las", again);
    EXPECT_EQ(ReadLas(text("same.las")).file.header.scale[0], 0.1);
    again.keeps_source_scale = false;
    write("finer.las", again);
    EXPECT_EQ(ReadLas(text("finer.las")).file.header.scale[0], 0.001);
}

TEST_F(PointSinks, ANumberThatMayNotFitItsFieldGetsAWiderOne) {
    PointOutline open = outline();
    open.columns[2].range = {};
    write("a.las", open);
    const ReadLas las(text("a.las"));
    EXPECT_EQ(las.values<std::uint8_t>("return_number_2"), (std::vector<std::uint8_t>{1, 2, 3}));
}

TEST_F(PointSinks, WhatLasCannotHoldIsRefusedAndLeavesNothing) {
    const std::size_t before = folder.entries();
    try {
        write("a.las", outline(), 1e9);
        FAIL() << "it should be refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadInput);
        EXPECT_SAYS(error.what(), "*a.las: *1e+09, 4500003, 102 ");
    }
    EXPECT_THROW(write("a.las", outline(), std::nan("")), Error);
    EXPECT_EQ(folder.entries(), before);
}

TEST_F(PointSinks, NamesDecide) {
    EXPECT_EQ(pointFormat("-"), PointFormat::kPly);
    EXPECT_EQ(pointFormat("a.b.laz"), PointFormat::kLaz);
    EXPECT_EQ(pointFormat("a.e57"), PointFormat::kE57);
    EXPECT_THROW(pointFormat("a.txt"), Error);
    EXPECT_THROW(openPointSink(folder.file("none/a.ply"), outline()), Error);
    write("a.ply", outline());
    EXPECT_THROW(openPointSink(folder.file("a.ply"), outline(), format::Existing::kKept)->finish(), Error);
}

} // namespace
} // namespace pointrt
