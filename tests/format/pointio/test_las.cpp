// SPDX-License-Identifier: Apache-2.0
// Headers, records and attributes of LAS files, checked against handmade bytes.
#include "format/pointio/las.h"

#include <cmath>
#include <gtest/gtest.h>

#include "format/base/error.h"
#include "format/pointio/las_fields.h"
#include "format/pointio/las_source_header.h"
#include "pointrt/pro_layout.h"
#include "tests/support/las_file.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

using test::extraBytes;
using test::LasParts;
using test::lasPoint;
using test::lasRecord;
using test::put;

constexpr std::uint16_t kRecordBytes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

/// The value of an attribute of the first point.
template <typename Number = std::uint8_t>
Number valueOf(const std::vector<LasField>& fields, const std::string& name, const std::string& point,
               std::size_t component = 0) {
    for (const LasField& field : fields) {
        if (field.name != name) continue;
        EXPECT_EQ(fieldBytes(field), field.components * sizeof(Number)) << name;
        std::vector<char> values(fieldBytes(field));
        unpackField(field, point.data(), point.size(), 1, values.data());
        Number number;
        std::memcpy(&number, values.data() + component * sizeof number, sizeof number);
        return number;
    }
    ADD_FAILURE() << "no " << name;
    return {};
}

std::string reasonOf(const std::string& bytes) {
    try {
        openLas(bytes);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadInput);
        return error.what();
    }
    return "";
}

TEST(Las, PointsOfEveryVersionAndFormatAreLocated) {
    for (const std::uint8_t minor : {0, 1, 2, 3, 4})
        for (std::uint8_t format = 0; format <= 10; ++format) {
            LasParts parts;
            parts.minor = minor;
            parts.format = format;
            parts.points = {lasPoint(kRecordBytes[format], 1, 2, 3, 0), lasPoint(kRecordBytes[format], 4, 5, 6, 7)};
            parts.records = {lasRecord("someone", 7, "text")};
            const std::string bytes = parts.bytes();
            const LasFile file = openLas(bytes);
            EXPECT_EQ(file.header.point_format, format);
            EXPECT_EQ(file.header.point_count, 2u);
            EXPECT_EQ(file.header.record_bytes, kRecordBytes[format]);
            EXPECT_EQ(bytes.substr(file.header.point_offset), parts.points[0] + parts.points[1]);
            ASSERT_NE(findVlr(file, "someone", 7), nullptr);
            EXPECT_EQ(findVlr(file, "someone", 7)->data, "text");
        }
}

TEST(Las, OldFormatsShareBytesBetweenAttributes) {
    std::string point = lasPoint(34, 0, 0, 0, 0);
    put(point, 12, std::uint16_t{54321});
    put(point, 14, std::uint8_t{0b1'0'101'011}); // edge, direction, number of returns, return
    put(point, 15, std::uint8_t{0b0'1'1'10110}); // withheld, key point, synthetic, class
    put(point, 16, std::int8_t{-90});
    put(point, 17, std::uint8_t{200});
    put(point, 18, std::uint16_t{60000});
    put(point, 20, 123456.789);
    put(point, 28, std::uint16_t{1});
    put(point, 30, std::uint16_t{257});
    put(point, 32, std::uint16_t{65535});
    const auto fields = lasFields(3);
    EXPECT_EQ(valueOf<std::uint16_t>(fields, "intensity", point), 54321);
    EXPECT_EQ(valueOf(fields, "return_number", point), 3);
    EXPECT_EQ(valueOf(fields, "number_of_returns", point), 5);
    EXPECT_EQ(valueOf(fields, "scan_direction_flag", point), 0);
    EXPECT_EQ(valueOf(fields, "edge_of_flight_line", point), 1);
    EXPECT_EQ(valueOf(fields, "classification", point), 22);
    EXPECT_EQ(valueOf(fields, "synthetic", point), 1);
    EXPECT_EQ(valueOf(fields, "key_point", point), 1);
    EXPECT_EQ(valueOf(fields, "withheld", point), 0);
    EXPECT_EQ(valueOf<std::int8_t>(fields, "scan_angle_rank", point), -90);
    EXPECT_EQ(valueOf(fields, "user_data", point), 200);
    EXPECT_EQ(valueOf<std::uint16_t>(fields, "point_source_id", point), 60000);
    EXPECT_EQ(valueOf<double>(fields, "gps_time", point), 123456.789);
    EXPECT_EQ(valueOf<std::uint16_t>(fields, "rgb16", point, 1), 257);
    EXPECT_EQ(valueOf<std::uint16_t>(fields, "rgb16", point, 2), 65535);
}

TEST(Las, NewFormatsHaveWiderFields) {
    std::string point = lasPoint(38, 0, 0, 0, 0);
    put(point, 14, std::uint8_t{0b1111'1010});      // number of returns, return
    put(point, 15, std::uint8_t{0b1'0'10'1'0'1'0}); // edge, direction, channel, overlap, withheld, key point, synthetic
    put(point, 16, std::uint8_t{255});
    put(point, 17, std::uint8_t{3});
    put(point, 18, std::int16_t{-30000});
    put(point, 20, std::uint16_t{9});
    put(point, 22, -1e300);
    put(point, 30, std::uint16_t{10});
    put(point, 34, std::uint16_t{12});
    put(point, 36, std::uint16_t{40000});
    const auto fields = lasFields(8);
    EXPECT_EQ(valueOf(fields, "return_number", point), 10);
    EXPECT_EQ(valueOf(fields, "number_of_returns", point), 15);
    EXPECT_EQ(valueOf(fields, "synthetic", point), 0);
    EXPECT_EQ(valueOf(fields, "key_point", point), 1);
    EXPECT_EQ(valueOf(fields, "withheld", point), 0);
    EXPECT_EQ(valueOf(fields, "overlap", point), 1);
    EXPECT_EQ(valueOf(fields, "scanner_channel", point), 2);
    EXPECT_EQ(valueOf(fields, "scan_direction_flag", point), 0);
    EXPECT_EQ(valueOf(fields, "edge_of_flight_line", point), 1);
    EXPECT_EQ(valueOf(fields, "classification", point), 255);
    EXPECT_EQ(valueOf<std::int16_t>(fields, "scan_angle", point), -30000);
    EXPECT_EQ(valueOf<std::uint16_t>(fields, "point_source_id", point), 9);
    EXPECT_EQ(valueOf<double>(fields, "gps_time", point), -1e300);
    EXPECT_EQ(valueOf<std::uint16_t>(fields, "rgb16", point, 0), 10);
    EXPECT_EQ(valueOf<std::uint16_t>(fields, "rgb16", point, 2), 12);
    EXPECT_EQ(valueOf<std::uint16_t>(fields, "nir", point), 40000);
}

/// Times and colours are at different offsets in each format.
TEST(Las, EachFormatHasItsOwnTimeAndColours) {
    struct Place {
        int format, time, rgb, nir;
    };
    for (const auto& [format, time, rgb, nir] : {Place{0, -1, -1, -1},
                                                 {1, 20, -1, -1},
                                                 {2, -1, 20, -1},
                                                 {3, 20, 28, -1},
                                                 {4, 20, -1, -1},
                                                 {5, 20, 28, -1},
                                                 {6, 22, -1, -1},
                                                 {7, 22, 30, -1},
                                                 {8, 22, 30, 36},
                                                 {9, 22, -1, -1},
                                                 {10, 22, 30, 36}}) {
        const auto placeOf = [all = lasFields(static_cast<std::uint8_t>(format))](const char* name) {
            for (const LasField& field : all)
                if (field.name == name) return static_cast<int>(field.at);
            return -1;
        };
        EXPECT_EQ(placeOf("gps_time"), time) << format;
        EXPECT_EQ(placeOf("rgb16"), rgb) << format;
        EXPECT_EQ(placeOf("nir"), nir) << format;
    }
}

/// Packing all attributes restores every bit of the record except wave packets.
TEST(Las, PackingInvertsUnpacking) {
    for (std::uint8_t format = 0; format <= 10; ++format) {
        std::string point = lasPoint(kRecordBytes[format], 0, 0, 0, static_cast<std::uint8_t>(77 * format + 1));
        std::string back(point.size(), '\0');
        for (const LasField& field : lasFields(format)) {
            std::vector<char> values(fieldBytes(field));
            unpackField(field, point.data(), point.size(), 1, values.data());
            packField(field, values.data(), point.size(), 1, back.data());
        }
        const std::size_t end = wavePacketAt(format) > 0 ? wavePacketAt(format) : point.size();
        EXPECT_EQ(back.substr(12, end - 12), point.substr(12, end - 12)) << int{format};
    }
}

LasFile withExtraBytes(LasParts& parts, std::string& bytes, const std::string& descriptors, const std::string& extra) {
    parts.points = {lasPoint(20, 0, 0, 0, 0) + extra};
    parts.records = {lasRecord("LASF_Spec", 4, descriptors)};
    bytes = parts.bytes();
    return openLas(bytes);
}

TEST(Las, ExtraBytesOfEveryType) {
    std::string extra, descriptors;
    const auto add = [&](std::uint8_t type, const std::string& name, const auto&... numbers) {
        descriptors += extraBytes(type, name);
        (put(extra, extra.size(), numbers), ...);
    };
    add(1, "u8", std::uint8_t{250});
    add(2, "i8", std::int8_t{-5});
    add(3, "u16", std::uint16_t{50000});
    add(4, "i16", std::int16_t{-500});
    add(5, "u32", std::uint32_t{4000000000});
    add(6, "i32", std::int32_t{-7});
    add(7, "u64", std::uint64_t{1} << 63);
    add(8, "i64", std::int64_t{-1});
    add(9, "f32", 1.5f);
    add(10, "f64", -2.25);
    add(13, "two", std::uint16_t{3}, std::uint16_t{4});
    add(30, "three", 1.0, 2.0, 3.0);
    LasParts parts;
    std::string bytes;
    LasFile file = withExtraBytes(parts, bytes, descriptors, extra);
    const auto fields = lasFields(file);
    const std::string& point = parts.points[0];
    EXPECT_EQ(valueOf<std::uint8_t>(fields, "u8", point), 250);
    EXPECT_EQ(valueOf<std::int8_t>(fields, "i8", point), -5);
    EXPECT_EQ(valueOf<std::uint16_t>(fields, "u16", point), 50000);
    EXPECT_EQ(valueOf<std::int16_t>(fields, "i16", point), -500);
    EXPECT_EQ(valueOf<std::uint32_t>(fields, "u32", point), 4000000000);
    EXPECT_EQ(valueOf<std::int32_t>(fields, "i32", point), -7);
    EXPECT_EQ(valueOf<std::uint64_t>(fields, "u64", point), std::uint64_t{1} << 63);
    EXPECT_EQ(valueOf<std::int64_t>(fields, "i64", point), -1);
    EXPECT_EQ(valueOf<float>(fields, "f32", point), 1.5f);
    EXPECT_EQ(valueOf<double>(fields, "f64", point), -2.25);
    EXPECT_EQ(valueOf<std::uint16_t>(fields, "two", point, 1), 4);
    EXPECT_EQ(valueOf<double>(fields, "three", point, 2), 3.0);
    EXPECT_TRUE(file.notes.empty());
}

TEST(Las, ScaledExtraBytesAreDoublesAndRoundTrip) {
    std::string extra;
    put(extra, 0, std::int16_t{-321});
    LasParts parts;
    std::string bytes;
    LasFile file = withExtraBytes(parts, bytes, extraBytes(4, "height", 8 | 16, 0.01, 100), extra);
    const auto fields = lasFields(file);
    ASSERT_EQ(fields.back().name, "height");
    EXPECT_EQ(fields.back().type, PRO_TYPE_F64);
    EXPECT_DOUBLE_EQ(valueOf<double>(fields, "height", parts.points[0]), 96.79);
    for (int raw = -32768; raw <= 32767; ++raw) {
        std::string point = parts.points[0], back = point;
        put(point, 20, static_cast<std::int16_t>(raw));
        std::vector<char> value(8);
        unpackField(fields.back(), point.data(), point.size(), 1, value.data());
        packField(fields.back(), value.data(), back.size(), 1, back.data());
        ASSERT_EQ(back, point) << raw;
    }
}

TEST(Las, UndescribedExtraBytesAreKept) {
    LasParts parts;
    std::string bytes;
    LasFile file = withExtraBytes(parts, bytes, extraBytes(0, "bare", 2) + extraBytes(1, "bare"), "abcdefghi");
    const auto fields = lasFields(file);
    EXPECT_EQ(valueOf<char>(fields, "bare", parts.points[0], 1), 'b');
    EXPECT_EQ(valueOf<char>(fields, "bare_2", parts.points[0]), 'c');
    EXPECT_EQ(valueOf<char>(fields, "ExtraBytes", parts.points[0], 3), 'g');
    EXPECT_EQ(valueOf<char>(fields, "ExtraBytes_2", parts.points[0], 1), 'i');
}

TEST(Las, DescriptorsThatDoNotFitLeaveUndescribedBytes) {
    LasParts parts;
    std::string bytes;
    LasFile file = withExtraBytes(parts, bytes, extraBytes(10, "long") + extraBytes(1, "next"), "ab");
    const auto fields = lasFields(file);
    EXPECT_EQ(fields.back().name, "ExtraBytes");
    EXPECT_EQ(fields.back().components, 2u);
}

TEST(Las, RecordsAfterThePoints) {
    LasParts parts;
    parts.minor = 4;
    parts.format = 6;
    parts.points = {lasPoint(30, 0, 0, 0, 0)};
    parts.extended_records = {lasRecord("a", 1, "first", true), lasRecord("b", 2, "second", true)};
    const std::string bytes = parts.bytes();
    const LasFile file = openLas(bytes);
    ASSERT_NE(findVlr(file, "b", 2), nullptr);
    EXPECT_EQ(findVlr(file, "b", 2)->data, "second");
    EXPECT_TRUE(findVlr(file, "b", 2)->extended);
}

TEST(Las, CountsOf32BitsReplaceMissing64BitOnes) {
    LasParts parts;
    parts.minor = 4;
    parts.points = {lasPoint(20, 0, 0, 0, 0)};
    std::string bytes = parts.bytes();
    put(bytes, 107, std::uint32_t{0});
    EXPECT_EQ(openLas(bytes).header.point_count, 1u);
    put(bytes, 107, std::uint32_t{1});
    put(bytes, 247, std::uint64_t{0});
    EXPECT_EQ(openLas(bytes).header.point_count, 1u);
}

TEST(Las, InconsistentHeadersAreRefused) {
    LasParts parts;
    parts.points = {lasPoint(20, 0, 0, 0, 0)};
    const auto with = [&](std::size_t at, auto number) {
        std::string bytes = parts.bytes();
        put(bytes, at, number);
        return reasonOf(bytes);
    };
    EXPECT_SAYS(with(25, std::uint8_t{6}), "*LAS 1.6");
    EXPECT_SAYS(with(24, std::uint8_t{2}), "*LAS 2.2");
    EXPECT_SAYS(with(104, std::uint8_t{11}), "*format 11");
    EXPECT_SAYS(with(105, std::uint16_t{19}), "*19 bytes*20");
    EXPECT_SAYS(with(107, std::uint32_t{2}), "promises 2 *1");
    EXPECT_SAYS(with(107, ~std::uint32_t{0}), "promises 4294967295 *1");
    EXPECT_SAYS(with(96, std::uint32_t{1000}), "*1000*247");
    EXPECT_SAYS(with(139, 0.0), "*scale");
    EXPECT_SAYS(with(163, double{NAN}), "*scale");
    EXPECT_SAYS(with(94, std::uint16_t{226}), "*header*226");
}

TEST(Las, TruncatedRecordsGiveANote) {
    LasParts parts;
    parts.points = {lasPoint(20, 0, 0, 0, 0)};
    std::string bytes = parts.bytes();
    put(bytes, 100, ~std::uint32_t{0});
    EXPECT_EQ(openLas(bytes).notes.size(), 1u);
}

TEST(Las, TheSourceHeaderRoundTrips) {
    LasParts parts;
    parts.minor = 4;
    parts.format = 6;
    parts.scale = 1.0 / 3;
    parts.points = {lasPoint(30, 0, 0, 0, 0)};
    parts.records = {lasRecord("LASF_Projection", 2112, "GEOGCS[]"), lasRecord("laszip encoded", 22204, "x"),
                     lasRecord("me", 1, std::string("\0\xff", 2))};
    parts.extended_records = {lasRecord("LASF_Spec", 65535, "waves", true), lasRecord("me", 2, "long", true)};
    const std::string bytes = parts.bytes();
    LasFile file = openLas(bytes);
    const auto source = parseLasSource(lasSourceHeader(file, false));
    ASSERT_TRUE(source);
    EXPECT_EQ(source->header_bytes, bytes.substr(0, 375));
    EXPECT_EQ(source->header.scale[1], 1.0 / 3);
    ASSERT_EQ(source->records.size(), 3u);
    EXPECT_EQ(source->records[1].vlr.user_id, "me");
    EXPECT_EQ(source->records[1].data, std::string("\0\xff", 2));
    EXPECT_TRUE(source->records[2].vlr.extended);
    EXPECT_EQ(parseLasSource(lasSourceHeader(file, true))->records.size(),
              2u); // moved points drop the coordinate system
    for (const char* text : {"", "{}", "[]", "{\"format\":\"las\",\"header\":\"TEFT\",\"vlrs\":[]}"})
        EXPECT_FALSE(parseLasSource(text)) << text;
}

} // namespace
} // namespace pointrt
