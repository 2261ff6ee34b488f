// SPDX-License-Identifier: Apache-2.0
#include "preprocess/tiles/splat_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "format/base/error.h"
#include "pointrt/pro_layout.h"
#include "tests/support/splat_scenes.h"

namespace pointrt {
namespace {

const TileKey kTile{2, {5, 0, 7}};

TileSplats fewSplats() {
    TileSplats splats;
    splats.positions = {{0, 1, 2}, {kCoreSteps - 1, -3, 4}, {7, 8, 9}};
    splats.normals = {normalWord({0, 0, 1}), normalWord({1, 0, 0}), normalWord({0, -1, 0})};
    splats.radii = {0.5f, 0.25f, 2};
    splats.colors = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    splats.noise = {0.125f, 0, 0.25f};
    splats.attributes = {{"classification", Scalar::kU8, 1, {2, 6, 2}},
                         {"heat", Scalar::kI16, 1, {1, 0, -1, -1, 5, 0}}};
    splats.error = 0.75;
    splats.spacing = 1.5;
    return splats;
}

std::string folderWithFile() {
    const std::string folder = test::temporaryPath("splat_files");
    std::filesystem::create_directories(folder);
    writeSplats(folder, kTile, fewSplats());
    return folder;
}

TEST(SplatFile, ReadsWhatWasWritten) {
    const std::string folder = folderWithFile();
    const TileSplats read = readSplats(folder, kTile), written = fewSplats();
    EXPECT_EQ(read.positions, written.positions);
    EXPECT_EQ(read.normals, written.normals);
    EXPECT_EQ(read.radii, written.radii);
    EXPECT_EQ(read.colors, written.colors);
    EXPECT_EQ(read.noise, written.noise);
    ASSERT_EQ(read.attributes.size(), 2u);
    EXPECT_EQ(read.attributes[1].name, "heat");
    EXPECT_EQ(read.attributes[1].type, Scalar::kI16);
    EXPECT_EQ(read.attributes[1].values, written.attributes[1].values);
    EXPECT_EQ(read.error, 0.75);
    EXPECT_EQ(read.spacing, 1.5);
}

TEST(SplatFile, DroppedArraysLeaveTheSummary) {
    const std::string folder = folderWithFile();
    const SplatFileSummary before = readSplatSummary(folder, kTile);
    for (int time = 0; time < 2; ++time) {
        dropArrays(folder, kTile);
        const SplatFileSummary after = readSplatSummary(folder, kTile);
        EXPECT_EQ(std::memcmp(&after.head, &before.head, sizeof after.head), 0);
        ASSERT_EQ(after.attributes.size(), 2u);
        EXPECT_EQ(after.attributes[1].name, "heat");
        EXPECT_FALSE(hasSplatFile(folder, kTile));
        EXPECT_THROW(readSplats(folder, kTile), Error);
    }
}

TEST(SplatFile, SummaryHasTheRanges) {
    const SplatFileSummary summary = readSplatSummary(folderWithFile(), kTile);
    EXPECT_EQ(summary.head.count, 3u);
    EXPECT_EQ(summary.head.radius_min, 0.25f);
    EXPECT_EQ(summary.head.radius_max, 2);
    EXPECT_EQ(summary.head.lowest, (PositionCode{0, -3, 2}));
    EXPECT_EQ(summary.head.highest, (PositionCode{kCoreSteps - 1, 8, 9}));
    EXPECT_EQ(summary.head.noise, 0.125f);
    ASSERT_EQ(summary.attributes.size(), 2u);
    EXPECT_EQ(summary.attributes[0].type, static_cast<std::uint32_t>(PRO_TYPE_U8));
    EXPECT_EQ(summary.attributes[1].low, -1);
    EXPECT_EQ(summary.attributes[1].high, 5);
}

TEST(SplatFile, SameSplatsSameBytes) {
    const std::string path = splatFileOf(folderWithFile(), kTile);
    const auto bytes = [&] {
        std::ifstream file(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const std::string first = bytes();
    folderWithFile();
    EXPECT_EQ(bytes(), first);
}

TEST(SplatFile, RefusesAnyDamage) {
    const std::string folder = folderWithFile(), path = splatFileOf(folder, kTile);
    std::ifstream file(path, std::ios::binary);
    const std::string good(std::istreambuf_iterator<char>(file), {});
    const auto open = [&](const std::string& bytes) {
        std::ofstream(path, std::ios::binary) << bytes;
        SplatFile opened(folder, kTile);
    };
    EXPECT_NO_THROW(open(good));
    for (std::size_t i = 0; i < good.size(); i += 3) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ 0x10);
        EXPECT_THROW(open(bad), Error) << "byte " << i;
    }
    for (std::size_t length = 0; length < good.size(); length += 7)
        EXPECT_THROW(open(good.substr(0, length)), Error) << "cut at " << length;
    EXPECT_THROW(open(good + std::string(8, '\0')), Error);
}

TEST(SplatFile, RefusesTheFileOfAnotherTile) {
    const std::string folder = folderWithFile();
    const TileKey other{2, {5, 0, 8}};
    std::filesystem::copy_file(splatFileOf(folder, kTile), splatFileOf(folder, other),
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_THROW(SplatFile(folder, other), Error);
    EXPECT_THROW(readSplatSummary(folder, other), Error);
    EXPECT_THROW(SplatFile(folder, {0, {0, 0, 0}}), Error);
}

TEST(SplatFile, AnEmptyTileKeepsItsSchema) {
    const std::string folder = folderWithFile();
    writeSplats(folder, kTile, emptyLike(fewSplats()));
    const SplatFile file(folder, kTile);
    EXPECT_TRUE(file.splats().positions.empty());
    EXPECT_EQ(file.schema().size(), 2u);
}

} // namespace
} // namespace pointrt
