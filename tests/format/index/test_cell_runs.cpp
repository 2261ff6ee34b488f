// SPDX-License-Identifier: Apache-2.0
// Rows of near splats: the run of each cell has its discs, and neighbours share common discs.
#include "format/index/cell_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "pointrt/pro_index_layout.h"

namespace pointrt {
namespace {

/// Flat discs of radius 1 along x, 0.1 apart.
std::vector<CellDisc> line(std::uint32_t count) {
    std::vector<CellDisc> discs(count);
    for (std::uint32_t k = 0; k < count; ++k)
        discs[k] = {k, {0.1f * static_cast<float>(k), 0, 0}, {0, 0, 1}, {1, 1, 0}, 1, 0.5f};
    return discs;
}

/// Cells of edge 1 along x from the block's lowest corner with these discs.
struct Block {
    std::vector<CellDisc> discs = line(40);
    std::vector<ListedCell> cells;
    CellBox box{{2, 2, 2}, 2, 1e-3f};

    void add(std::vector<std::uint32_t> hittable, std::vector<std::uint32_t> blending = {}) {
        ListedCell cell;
        for (const std::uint32_t k : hittable) cell.lists.hittable.push_back(&discs[k]);
        for (const std::uint32_t k : blending) cell.lists.blending.push_back(&discs[k]);
        cell.box = {{static_cast<float>(cells.size()) + 0.5f, 0.5f, 0.5f}, 0.5f, 1e-3f};
        cells.push_back(cell);
    }

    CellWords encode() const {
        CellWords words;
        encodeCells(cells, box, words);
        return words;
    }
};

std::vector<std::uint32_t> runOf(const CellWords& words, std::size_t cell) {
    const std::uint32_t* at = &words.cells[cell * PRO_CELL_WORDS];
    const auto first = words.listed.begin() + at[PRO_CELL_FIRST];
    std::vector<std::uint32_t> run(first, first + (at[PRO_CELL_COUNT] & PRO_CELL_COUNT_MASK));
    std::sort(run.begin(), run.end());
    return run;
}

std::vector<std::uint32_t> blendingOf(const CellWords& words, std::size_t cell) {
    const std::uint32_t* at = &words.cells[cell * PRO_CELL_WORDS];
    std::vector<std::uint32_t> splats;
    for (std::uint32_t k = 0; k < (at[PRO_CELL_BLENDING_COUNT] & PRO_CELL_BLENDING_MASK); ++k) {
        const int number = words.blending.at(at[PRO_CELL_BLENDING] + k);
        splats.push_back(words.listed.at(at[PRO_CELL_FIRST] + static_cast<std::size_t>(number)));
    }
    return splats;
}

using List = std::vector<std::uint32_t>;

TEST(CellRuns, NeighboursShareCommonDiscs) {
    Block block;
    block.add({0, 1, 2, 3});
    block.add({2, 3, 4, 5});
    block.add({5, 4, 6, 7});
    const CellWords words = block.encode();
    EXPECT_EQ(words.listed.size(), 8u) << "each splat once";
    EXPECT_EQ(runOf(words, 0), (List{0, 1, 2, 3}));
    EXPECT_EQ(runOf(words, 1), (List{2, 3, 4, 5}));
    EXPECT_EQ(runOf(words, 2), (List{4, 5, 6, 7}));
}

TEST(CellRuns, ContinueWithTheCellThatSharesMost) {
    Block block;
    block.add({0, 1, 2, 3});
    block.add({10, 11, 12, 13});
    block.add({2, 3, 10, 11});
    EXPECT_EQ(block.encode().listed.size(), 8u);
}

TEST(CellRuns, NumberSplatsThatOnlyBlend) {
    Block block;
    block.add({4, 5}, {6, 20});
    block.add({5, 6}, {4});
    const CellWords words = block.encode();
    EXPECT_EQ(words.listed.size(), 6u) << "4, 5, 6, one for an even number, 20 that is never hit, and one more";
    EXPECT_EQ(blendingOf(words, 0), (List{6, 20}));
    EXPECT_EQ(blendingOf(words, 1), (List{4}));
    EXPECT_EQ(words.blending.size(), 4u);
}

TEST(CellRuns, HaveAnEvenNumber) {
    Block block;
    block.add({0, 1, 2});
    const CellWords words = block.encode();
    ASSERT_EQ(words.listed.size(), 4u);
    EXPECT_EQ(words.listed[3], words.listed[2]) << "a duplicate cannot be closer";
}

TEST(CellRuns, AreRelativeToTheMiddleOfTheirBlock) {
    Block block;
    block.add({0, 1});
    block.add({1, 2});
    const CellWords words = block.encode();
    const auto offset = [&](std::size_t cell, std::uint32_t axis) {
        const std::uint32_t word = words.cells[cell * PRO_CELL_WORDS + PRO_CELL_BLENDING_COUNT];
        const std::uint32_t first = PRO_CELL_OFFSET_SHIFT + axis * PRO_CELL_OFFSET_BITS;
        return static_cast<int>(word << (32 - first - PRO_CELL_OFFSET_BITS)) >> (32 - PRO_CELL_OFFSET_BITS);
    };
    EXPECT_EQ(offset(0, 0), 3); // from 0.5 to 2, in half edges
    EXPECT_EQ(offset(1, 0), 1);
    EXPECT_EQ(offset(1, 2), 3);
}

/// Discs of 1/20 of the block would be too coarse relative to its middle: its halves have rows of their own.
TEST(CellRuns, AreOfHalvesIfDiscsAreSmall) {
    Block block;
    for (CellDisc& disc : block.discs) disc.radius = 0.01f;
    block.add({0, 1});
    block.add({1, 2});
    const CellWords words = block.encode();
    EXPECT_EQ(words.listed.size(), 4u) << "disc 1 is stored twice";
    EXPECT_EQ(words.cells[PRO_CELL_BLENDING_COUNT] >> PRO_CELL_OFFSET_SHIFT, 0u) << "relative to the cell's own middle";
}

TEST(CellRuns, ContainAllDiscsOfRandomCells) {
    std::mt19937 random(4);
    for (int round = 0; round < 300; ++round) {
        Block block;
        std::size_t listed = 0;
        const std::size_t cells = 1 + random() % 4;
        for (std::size_t c = 0; c < cells; ++c) {
            List all(block.discs.size());
            for (std::uint32_t k = 0; k < all.size(); ++k) all[k] = k;
            std::shuffle(all.begin(), all.end(), random);
            const auto hits = static_cast<std::ptrdiff_t>(1 + random() % 20),
                       blends = static_cast<std::ptrdiff_t>(random() % 10);
            block.add({all.begin(), all.begin() + hits}, {all.begin() + hits, all.begin() + hits + blends});
            listed += static_cast<std::size_t>(hits);
        }
        const CellWords words = block.encode();
        for (std::size_t c = 0; c < cells; ++c) {
            List hits, blends;
            for (const CellDisc* disc : block.cells[c].lists.hittable) hits.push_back(disc->splat);
            for (const CellDisc* disc : block.cells[c].lists.blending) blends.push_back(disc->splat);
            std::sort(hits.begin(), hits.end());
            ASSERT_EQ(runOf(words, c), hits);
            ASSERT_EQ(blendingOf(words, c), blends);
        }
        EXPECT_LE(words.listed.size(), listed + block.discs.size() + 1);
    }
}

} // namespace
} // namespace pointrt
