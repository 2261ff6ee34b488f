// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "file_bytes.h"
#include "format/set/verify_tile.h"
#include "made_set.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

struct VerifyTile : testing::Test {
    test::TemporaryFolder folder;
    TileSet set = test::makeSet(folder.path);
    SetTile& tile = set.tiles.back(); ///< 0-1-1-0
    std::vector<test::LatticeSplat> fine = test::sheet(16, 2, test::sheetRadius(16));

    /// The findings of all tiles as lines.
    std::string findings() {
        std::string lines;
        for (std::size_t i = 0; i < set.tiles.size(); ++i)
            for (const TileFinding& finding : verifyTile(set, folder.path, i))
                lines += set.tiles[i].file + " " + std::to_string(finding.number) + " " + finding.text + "\n";
        return lines;
    }
};

TEST_F(VerifyTile, FindsNothingInAValidSet) {
    EXPECT_EQ(findings(), "");
    EXPECT_GT(tile.stored, tile.splats + 16) << "a row and a column of neighbours' splats";
}

TEST_F(VerifyTile, FindsCopiesThatDifferFromTheNeighboursSplats) {
    for (test::LatticeSplat& each : fine)
        if (each.code[0] < test::kCoreSteps && each.code[1] > test::kCoreSteps) each.splat.color[1] ^= 1;
    test::writeTile(set, tile, fine, folder.path);
    EXPECT_SAYS(findings(), "tiles/0-1-1-0.pro 0 16 *core of tiles/0-0-1-0.pro\n"
                            "tiles/0-1-1-0.pro 0 lacks 8 *tiles/0-0-1-0.pro\n");
}

TEST_F(VerifyTile, FindsDisplacedCopies) {
    for (test::LatticeSplat& each : fine)
        if (each.code[0] < test::kCoreSteps && each.code[1] > test::kCoreSteps) ++each.code[2];
    test::writeTile(set, tile, fine, folder.path);
    EXPECT_SAYS(findings(), "tiles/0-1-1-0.pro 0 16 *core of tiles/0-0-1-0.pro\n"
                            "tiles/0-1-1-0.pro 0 lacks 8 *tiles/0-0-1-0.pro\n");
}

TEST_F(VerifyTile, FindsMissingCopies) {
    std::erase_if(fine, [&](const auto& each) { return !test::isInCore(each, {1, 1, 0}); });
    test::writeTile(set, tile, fine, folder.path);
    EXPECT_SAYS(findings(), "tiles/0-1-1-0.pro 0 lacks 8 *tiles/0-1-0-0.pro\n"
                            "tiles/0-1-1-0.pro 0 lacks 8 *tiles/0-0-1-0.pro\n");
}

TEST_F(VerifyTile, FindsSplatsInCellsWithoutATile) {
    fine.push_back(fine.back());
    fine.back().code[2] = test::kCoreSteps + 10;
    test::writeTile(set, tile, fine, folder.path);
    EXPECT_SAYS(findings(), "tiles/0-1-1-0.pro 0 1 *without a tile\n");
}

/// Copies from an original tile of a coarser level are re-encoded.
TEST_F(VerifyTile, AcceptsSplatsFromACoarserOriginalTile) {
    set.levels.push_back(set.levels[1]);
    set.tiles.push_back({.level = 2, .file = tileFileName(2, {}), .error = 0.5});
    set.tiles.push_back({.level = 1, .cell = {1, 0, 0}, .file = tileFileName(1, {1, 0, 0})});
    set.bounds_max = {1016, 2016, 316};
    arrangeTiles(set); // 2-0-0-0, 1-0-0-0, 1-1-0-0, and the four of level 0
    std::vector<test::LatticeSplat> coarse = test::sheet(8, 1, test::sheetRadius(16)), beside = coarse;
    test::writeTile(set, set.tiles[0], coarse, folder.path);
    for (test::LatticeSplat& each : beside) each.code[0] += test::kCoreSteps;
    coarse.insert(coarse.end(), beside.begin(), beside.end());
    test::writeTile(set, set.tiles[1], coarse, folder.path);
    test::writeTile(set, set.tiles[2], coarse, folder.path);
    fine.push_back(fine.back());
    fine.back().code[0] = 2 * test::kCoreSteps + 10;
    test::writeTile(set, set.tiles[6], fine, folder.path);
    EXPECT_EQ(findings(), "");
    set.tiles[2].error = 0.25; // no longer original, according to set.json
    EXPECT_SAYS(findings(), "tiles/0-1-1-0.pro 0 1 *without a tile\n");
}

/// An original tile has copies of original splats only, and therefore none from a merged neighbour.
TEST_F(VerifyTile, NeedsNoMergedSplatsInOriginalTiles) {
    set.levels.push_back(set.levels[1]);
    set.bounds_max = {1016, 2016, 316};
    set.tiles.push_back({.level = 2, .file = tileFileName(2, {}), .error = 0.5});
    set.tiles.push_back({.level = 1, .cell = {1, 0, 0}, .file = tileFileName(1, {1, 0, 0})});
    arrangeTiles(set);
    std::vector<test::LatticeSplat> merged = test::sheet(8, 1, test::sheetRadius(16)), original = merged;
    test::writeTile(set, set.tiles[0], merged, folder.path);
    for (test::LatticeSplat& each : original) each.code[0] += test::kCoreSteps;
    test::writeTile(set, set.tiles[2], original, folder.path); // without the merged ones
    EXPECT_EQ(findings(), "") << "splats that a merged tile lacks may be merged in its own";
    merged.insert(merged.end(), original.begin(), original.end());
    test::writeTile(set, set.tiles[1], merged, folder.path);
    EXPECT_EQ(findings(), "");
}

TEST_F(VerifyTile, CountsTheSplatsInTheCore) {
    ++tile.splats;
    EXPECT_SAYS(findings(), "tiles/0-1-1-0.pro 0 *core*64*65\n");
}

TEST_F(VerifyTile, FindsSplatsBeyondTheBounds) {
    set.bounds_max[0] = 1007.7; // the last column is at 1007.75
    EXPECT_SAYS(findings(), "tiles/0-1-0-0.pro 0 *bounds\n"
                            "tiles/0-1-1-0.pro 0 *bounds\n");
}

TEST_F(VerifyTile, NumbersFindingsOfDamagedFiles) {
    const std::string path = tilePath(folder.path, tile);
    test::Bytes bytes = test::readBytes(path);
    bytes[test::loadAt<std::uint64_t>(bytes, test::recordOf(bytes, PRO_KIND_SPLT) + PRO_SEC_OFF_OFFSET)] ^=
        std::byte{1};
    test::writeBytes(path, bytes);
    EXPECT_TRUE(findings().starts_with("tiles/0-1-1-0.pro 2012 ")) << findings();
    std::filesystem::remove(path);
    EXPECT_EQ(findings(), "tiles/0-1-1-0.pro 0 No such file or directory\n");
}

} // namespace
} // namespace pointrt
