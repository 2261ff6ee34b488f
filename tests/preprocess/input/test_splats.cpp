// SPDX-License-Identifier: Apache-2.0
// Gaussian splats in all formats, each written here byte by byte.
#include "tests/preprocess/input/input_fixture.h"

#include <array>
#include <cmath>
#include <zstd.h>

namespace pointrt {
namespace {

using SplatsTest = InputTest;

/// Radius of a disc in standard deviations.
constexpr float kDeviations = 2.2f;

/// A Gaussian, to be encoded in each format.
struct Blob {
    std::array<float, 3> centre = {1.5f, -2, 0.25f};
    std::array<float, 3> log_deviations = {-2, -3, -5};
    std::array<float, 4> rotation = {1, 0, 0, 0}; ///< w x y z
    float opacity = 0.8f;
};

/// A quarter rotation about +x, which takes +z to -y.
const std::array<float, 4> kSplatsTurned = {std::sqrt(0.5f), std::sqrt(0.5f), 0, 0};

float logit(float share) { return std::log(share / (1 - share)); }

std::string plyHeader(std::size_t count, bool flat = false, const std::string& more = "") {
    std::string text = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", count);
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"})
        text += fmt::format("property float {}\n", name);
    text += more;
    for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
        if (!flat || std::string(name) != "scale_2") text += fmt::format("property float {}\n", name);
    return text + "end_header\n";
}

std::string plyRow(const Blob& blob, bool flat = false) {
    std::string row = bytesOf(blob.centre) + bytesOf(std::array<float, 3>{}) + bytesOf(std::array<float, 3>{0, 9, -9});
    row += bytesOf(logit(blob.opacity));
    row += flat ? bytesOf(blob.log_deviations).substr(0, 8) : bytesOf(blob.log_deviations);
    return row + bytesOf(blob.rotation);
}

std::string splatRow(const Blob& blob) {
    std::string row = bytesOf(blob.centre);
    for (const float logarithm : blob.log_deviations) row += bytesOf(std::exp(logarithm));
    row += std::string("\x80\xff\0", 3) + static_cast<char>(std::lround(255 * blob.opacity));
    for (const float part : blob.rotation) row += static_cast<char>(std::min(255l, std::lround(128 * part + 128)));
    return row;
}

/// The expected result for the default Blob.
void expectDisc(const Cloud& cloud, const Vec3f& axis) {
    ASSERT_GE(cloud.positions.size(), 1u);
    EXPECT_LT((world(cloud, 0) - Vec3d(1.5, -2, 0.25)).norm(), 1e-6);
    ASSERT_FALSE(cloud.normals.empty());
    EXPECT_GT(std::abs(cloud.normals[0].dot(axis)), 0.9999f);
    EXPECT_FALSE(cloud.normal_sides);
    EXPECT_NEAR(cloud.radii[0], kDeviations * std::exp(-8 / 3.0f), 1e-6);
    EXPECT_EQ(cloud.colors[0], (Rgb8{128, 255, 0}));
    EXPECT_NEAR(numbersOf(cloud, "opacity")[0], 0.8, 1e-6);
    EXPECT_EQ(attributeNames(cloud), Names{"opacity"});
}

TEST_F(SplatsTest, AsTrained) {
    const Cloud cloud = readText("a.ply", plyHeader(2) + plyRow({}) + plyRow({.rotation = kSplatsTurned}));
    expectDisc(cloud, Vec3f::UnitZ());
    EXPECT_GT(std::abs(cloud.normals[1].y()), 0.9999f);
    EXPECT_EQ(cloud.world.up, Vec3d(0, -1, 0));
    EXPECT_SAYS(notesOf(cloud), (folder / "a.ply").string() + ": *2.2 *transparency and elongation\n");
}

TEST_F(SplatsTest, AsTrainedInTwoDimensions) {
    expectDisc(readText("a.ply", plyHeader(1, true) + plyRow({}, true)), Vec3f::UnitZ());
}

TEST_F(SplatsTest, ViewDependentColourIsNoted) {
    const std::string bytes = plyRow({});
    const std::string text =
        plyHeader(1, false, "property float f_rest_0\n") + bytes.substr(0, 36) + bytesOf(1.f) + bytes.substr(36);
    EXPECT_HAS(notesOf(readText("a.ply", text)), "elongation *view-dependent");
}

TEST_F(SplatsTest, FaintOnesAreDropped) {
    const Cloud cloud =
        readText("a.ply", plyHeader(3) + plyRow({.opacity = 0.19f}) + plyRow({}) + plyRow({.opacity = 0.21f}));
    expectDisc(cloud, Vec3f::UnitZ());
    EXPECT_EQ(cloud.points_read, 3u);
    EXPECT_EQ(cloud.points_filtered, 1u);
    EXPECT_EQ(cloud.positions.size(), 2u);
    EXPECT_HAS(notesOf(cloud), "left out: 1 of 3 *opacity *0.2");
    EXPECT_HAS(reasonOfText("b.ply", plyHeader(1) + plyRow({.opacity = 0.1f})), "none of its 1 *opacity *0.2");
}

TEST_F(SplatsTest, SkiesAreDropped) {
    std::string rows = plyRow({.log_deviations = {3, 3, -3}});
    for (int i = 0; i < 200; ++i) rows += plyRow({.centre = {0.05f * static_cast<float>(i), 0, 0}});
    const Cloud cloud = readText("a.ply", plyHeader(201) + rows);
    EXPECT_EQ(cloud.positions.size(), 200u);
    EXPECT_EQ(cloud.points_filtered, 1u);
    EXPECT_HAS(notesOf(cloud), "left out: 1 *sky");
}

TEST_F(SplatsTest, RoundOnesHaveNoNormal) {
    const Cloud cloud = readText("a.ply", plyHeader(2) + plyRow({.log_deviations = {-3, -3, -3}}) + plyRow({}));
    EXPECT_TRUE(cloud.normals[0].isZero(0));
    EXPECT_FALSE(cloud.normals[1].isZero(0));
    EXPECT_NEAR(cloud.radii[0], kDeviations * std::exp(-3.0f), 1e-6);
}

TEST_F(SplatsTest, InvalidOnesAreDropped) {
    const Cloud cloud = readText("a.ply", plyHeader(3) + plyRow({.centre = {NAN, 0, 0}}) +
                                              plyRow({.log_deviations = {NAN, 900, -900}, .rotation = {0, 0, 0, 0}}) +
                                              plyRow({.centre = {5, 5, 5}}));
    EXPECT_EQ(cloud.points_non_finite, 1u);
    EXPECT_EQ(cloud.positions.size(), 2u);
    EXPECT_EQ(cloud.radii[0], 0);
    EXPECT_TRUE(cloud.normals[0].isZero(0));
}

/// Of 1 or 257 splats, the last of which lies in a chunk of its own.
std::string packedPly(std::uint32_t count, bool color_range, std::uint32_t rotation) {
    const std::uint32_t chunks = (count + 255) / 256;
    std::string text = fmt::format("ply\nformat binary_little_endian 1.0\nelement chunk {}\n", chunks);
    for (const char* name : {"min_x", "min_y", "min_z", "max_x", "max_y", "max_z", "min_scale_x", "min_scale_y",
                             "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z"})
        text += fmt::format("property float {}\n", name);
    for (const char* name : {"min_r", "min_g", "min_b", "max_r", "max_g", "max_b"})
        if (color_range) text += fmt::format("property float {}\n", name);
    text += fmt::format("element vertex {}\n", count);
    for (const char* name : {"position", "rotation", "scale", "color"})
        text += fmt::format("property uint packed_{}\n", name);
    text += "end_header\n";
    for (std::uint32_t i = 0; i < chunks; ++i) {
        const float x = 100 * static_cast<float>(i);
        // 1.5 is 3 of 2047 steps of half a unit, -2 is 1 of 1023 steps of 1 from -3, 0.25 none of them from 0.25
        for (const float value : {x, -3.f, 0.25f, x + 1023.5f, 1020.f, 100.f, -2.f, -3.f, -5.f, -2.f, -3.f, -5.f})
            text += bytesOf(value);
        for (const float value : {0.f, 0.f, 0.f, 1.f, 2.f, 1.f})
            if (color_range) text += bytesOf(value);
    }
    for (std::uint32_t i = 0; i < count; ++i)
        text += bytesOf(3u << 21 | 1u << 11) + bytesOf(rotation) + bytesOf(0x12345678u) + bytesOf(0x80ff00ccu);
    return text;
}

/// 10-bit components cannot represent zero; the nearest value is half a step away.
constexpr std::uint32_t kNearlyStill = 512u << 20 | 512u << 10 | 512u;

TEST_F(SplatsTest, PackedBySuperSplat) {
    for (const bool color_range : {false, true}) {
        const Cloud cloud = readText("a.ply", packedPly(257, color_range, kNearlyStill));
        expectDisc(cloud, Vec3f::UnitZ());
        EXPECT_LT((world(cloud, 256) - Vec3d(101.5, -2, 0.25)).norm(), 1e-4);
        EXPECT_EQ(cloud.world.up, Vec3d(0, -1, 0));
    }
    // w, the largest component, is sqrt(1/2); x is the value of code 1023
    const Cloud turned = readText("b.ply", packedPly(1, false, 1023u << 20 | 512u << 10 | 512u));
    EXPECT_GT(std::abs(turned.normals[0].y()), 0.999f);
}

TEST_F(SplatsTest, InvalidPackedOnesAreRefused) {
    const std::string good = packedPly(1, false, kNearlyStill);
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_HAS(reasonOfText("a.ply", with("element chunk 1", "element chunk 0")), "0 chunks *1");
    EXPECT_HAS(reasonOfText("a.ply", with("element chunk 1", "element chunk 4000000000")), "truncated: ");
    EXPECT_HAS(reasonOfText("a.ply", with("element chunk", "element bunch")), "no chunks *1 packed");
    EXPECT_HAS(reasonOfText("a.ply", with("uint packed_scale", "int packed_scale")), "'packed_scale' *uint");
    EXPECT_HAS(reasonOfText(
                   "a.ply",
                   "ply\nformat ascii 1.0\nelement chunk 4000000000\nelement vertex 1\nproperty uint packed_position\n"
                   "property uint packed_rotation\nproperty uint packed_scale\nproperty uint packed_color\nend_header\n"
                   "1 2 3 4\n"),
               "no chunks *1 packed"); // empty chunks do not count
}

TEST_F(SplatsTest, OfThirtyTwoBytes) {
    const Cloud cloud =
        readText("a.splat", splatRow({}) + splatRow({.rotation = kSplatsTurned}) + splatRow({.opacity = 0.1f}));
    expectDisc(cloud, Vec3f::UnitZ());
    EXPECT_GT(std::abs(cloud.normals[1].y()), 0.999f);
    EXPECT_EQ(cloud.positions.size(), 2u);
    EXPECT_EQ(cloud.world.up, Vec3d(0, -1, 0));
    EXPECT_HAS(reasonOfText("b.splat", splatRow({}) + "x"), "33 bytes *32");
    EXPECT_HAS(reasonOfText("c.splat", std::string(64, '\0')), "c.splat: *not Gaussians");
    std::string many;
    for (int i = 0; i < 64; ++i) many += splatRow({});
    EXPECT_EQ(readText("noname", many).positions.size(), 64u);
}

struct Spz {
    std::uint32_t version = 3, count = 1;
    std::uint8_t degree = 0, fractional_bits = 12, streams = 5;
};

std::string spzHeader(const Spz& spz) {
    return "NGSP" + bytesOf(spz.version) + bytesOf(spz.count) + bytesOf(spz.degree) + bytesOf(spz.fractional_bits) +
           '\0' + static_cast<char>(spz.version == 4 ? spz.streams : 0);
}

/// One splat, with its rotation in the encoding of the version.
std::vector<std::string> spzArrays(std::uint32_t version, bool turned = false) {
    std::string position;
    if (version == 1)
        for (const int half : {0x3e00, 0xc000, 0x3400}) position += bytesOf(static_cast<std::uint16_t>(half));
    else
        for (const int fixed : {6144, -8192, 1024}) position += bytesOf(fixed).substr(0, 3);
    const std::string rotation = version < 3
                                     ? (turned ? std::string("\xda\x80\x80", 3) : std::string("\x80\x80\x80", 3))
                                     : bytesOf(3u << 30 | (turned ? 511u << 20 : 0u));
    return {position, "\xcc", std::string("\x80\xff\0", 3), std::string("\x80\x70\x50", 3), rotation};
}

std::string joined(const std::vector<std::string>& parts) {
    std::string all;
    for (const std::string& part : parts) all += part;
    return all;
}

std::string zstdPacked(const std::string& bytes) {
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
    return packed;
}

std::string spz4(const std::vector<std::string>& arrays, Spz spz = {4}) {
    std::string table, streams;
    for (const std::string& array : arrays) {
        const std::string packed = zstdPacked(array);
        table += bytesOf<std::uint64_t>(packed.size()) + bytesOf<std::uint64_t>(array.size());
        streams += packed;
    }
    return spzHeader(spz) + bytesOf(32u) + std::string(12, '\0') + table + streams;
}

TEST_F(SplatsTest, SpzOfAllVersions) {
    for (const std::uint32_t version : {1u, 2u, 3u}) {
        SCOPED_TRACE(version);
        expectDisc(readText("a.spz", gzipped(spzHeader({version}) + joined(spzArrays(version)))), Vec3f::UnitZ());
        const Cloud turned = readText("b.spz", spzHeader({version}) + joined(spzArrays(version, true)));
        EXPECT_GT(std::abs(turned.normals[0].y()), 0.999f);
        EXPECT_EQ(turned.world.up, Vec3d(0, 1, 0));
    }
    expectDisc(readText("c.spz", spz4(spzArrays(4))), Vec3f::UnitZ());
    EXPECT_GT(std::abs(readText("d.spz", spz4(spzArrays(4, true))).normals[0].y()), 0.999f);
}

TEST_F(SplatsTest, SpzWithHarmonicsNotesTheLoss) {
    EXPECT_HAS(notesOf(readText("a.spz", spzHeader({3, 1, 1}) + joined(spzArrays(3)) + std::string(9, '\1'))),
               "elongation *view-dependent");
}

TEST_F(SplatsTest, InvalidSpzIsRefused) {
    const std::string body = joined(spzArrays(3));
    EXPECT_HAS(reasonOfText("a.spz", "NGSP\3"), "SPZ header *truncated");
    EXPECT_HAS(reasonOfText("a.spz", gzipped(std::string(64, 'x'))), "'NGSP'");
    EXPECT_HAS(reasonOfText("a.spz", spzHeader({0}) + body), "version 0*1 to 4");
    EXPECT_HAS(reasonOfText("a.spz", spzHeader({0xffffffff}) + body), "version 4294967295");
    EXPECT_HAS(reasonOfText("a.spz", spzHeader({3, 0}) + body), "no points");
    EXPECT_HAS(reasonOfText("a.spz", spzHeader({3, 2}) + body), "truncated: *promises 2 ");
    EXPECT_HAS(reasonOfText("a.spz", gzipped(spzHeader({3, 0xffffffff}) + body)), "promises 4294967295 ");
    EXPECT_HAS(reasonOfText("a.spz", spz4(spzArrays(4), {4, 0xffffffff})), "promises 4294967295 ");
    EXPECT_HAS(reasonOfText("a.spz", spzHeader({3, 1, 0, 255}) + body), "255 fractional bits");
    EXPECT_HAS(reasonOfText("a.spz", spz4(spzArrays(4), {4, 2})), "stream 0 *9 bytes*2 *18");
    EXPECT_HAS(reasonOfText("a.spz", spz4(spzArrays(4), {4, 1, 0, 12, 4})), "4 streams*5");
    EXPECT_HAS(reasonOfText("a.spz", spz4(spzArrays(4), {4, 1, 0, 12, 255})), "table of streams");
    for (const std::uint32_t table : {0u, 31u, 0xffffffffu}) {
        std::string text = spz4(spzArrays(4));
        EXPECT_HAS(reasonOfText("a.spz", text.replace(16, 4, bytesOf(table))), "table of streams");
    }
    // a stream that expands to more than its declared size
    std::vector<std::string> arrays = spzArrays(4);
    std::string text = spz4(arrays);
    arrays[0] += std::string(1 << 20, '\0');
    const std::string bomb = zstdPacked(arrays[0]);
    text.replace(32, 8, bytesOf<std::uint64_t>(bomb.size()));
    text.replace(32 + 5 * 16, zstdPacked(spzArrays(4)[0]).size(), bomb);
    EXPECT_HAS(reasonOfText("a.spz", text), "zstd *invalid");
}

TEST_F(SplatsTest, MislabelledOnesAreDetectedByContent) {
    EXPECT_EQ(readText("a.ply", spzHeader({3}) + joined(spzArrays(3))).positions.size(), 1u);
    EXPECT_EQ(readText("a.spz", plyHeader(1) + plyRow({})).positions.size(), 1u);
    EXPECT_EQ(readText("a.splat", plyHeader(1) + plyRow({})).positions.size(), 1u);
    EXPECT_HAS(reasonOfText("b.splat", "1 2 3\n4 5 6\n"), "12 bytes *32");
}

TEST_F(SplatsTest, EveryPrefixIsReadOrRefused) {
    readPrefixes("a.ply", plyHeader(1) + plyRow({}));
    readPrefixes("b.ply", packedPly(1, true, kNearlyStill));
    readPrefixes("a.splat", splatRow({}) + splatRow({}));
    readPrefixes("a.spz", spzHeader({3}) + joined(spzArrays(3)));
    readPrefixes("b.spz", gzipped(spzHeader({2}) + joined(spzArrays(2))));
    readPrefixes("c.spz", spz4(spzArrays(4)));
}

} // namespace
} // namespace pointrt
