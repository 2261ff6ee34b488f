// SPDX-License-Identifier: Apache-2.0
// Gaussians of all formats read as discs, and what is refused however they are read.
#include "tests/preprocess/input/gaussian/gaussian_files.h"

namespace pointrt {
namespace {

using test::Blob, test::kNearlyStill, test::joined, test::packedPly, test::plyHeader, test::plyRow, test::Spz,
    test::spz4, test::spzArrays, test::spzHeader, test::splatRow, test::zstdPacked;

/// Reads Gaussians as discs.
class SplatsTest : public InputTest {
protected:
    static ReadOptions asDiscs() {
        ReadOptions options;
        options.gaussians_as_discs = true;
        return options;
    }
    Cloud readText(const std::string& name, const std::string& bytes) const {
        return read(write(name, bytes), asDiscs());
    }
    std::string reasonOfText(const std::string& name, const std::string& bytes) const {
        return reasonOf(write(name, bytes), asDiscs());
    }
};

/// Radius of a disc in standard deviations.
constexpr float kDeviations = 2.2f;

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
    const Cloud cloud = readText("a.ply", plyHeader(2) + plyRow({}) + plyRow({.rotation = test::kQuarterAboutX}));
    expectDisc(cloud, Vec3f::UnitZ());
    EXPECT_GT(std::abs(cloud.normals[1].y()), 0.9999f);
    EXPECT_EQ(cloud.world.up, Vec3d(0, -1, 0));
    EXPECT_SAYS(notesOf(cloud), (folder / "a.ply").string() + ": *2.2 *transparency and elongation\n");
}

TEST_F(SplatsTest, AsTrainedInTwoDimensions) {
    expectDisc(readText("a.ply", plyHeader(1, true) + plyRow({}, true)), Vec3f::UnitZ());
}

TEST_F(SplatsTest, ViewDependentColourIsNoted) {
    const std::string text = test::gaussianPly({{.rest = std::vector<float>(9)}});
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
    EXPECT_HAS(notesOf(cloud), "left out: 1 *quarter of the scene");
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
        readText("a.splat", splatRow({}) + splatRow({.rotation = test::kQuarterAboutX}) + splatRow({.opacity = 0.1f}));
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

} // namespace
} // namespace pointrt
