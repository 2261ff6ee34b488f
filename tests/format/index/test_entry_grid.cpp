// SPDX-License-Identifier: Apache-2.0
// Skips of the grid and of bricks against counts of filled cells in the skipped cubes.
#include "format/index/entry_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "format/index/bricks.h"
#include "format/index/cell_skips.h"
#include "tests/format/scene_builder.h"
#include "tests/support/index_values.h"

namespace pointrt {
namespace {

using test::isFilled;
using test::Scene;
using test::sceneOf;

/// Filled cells of a box, with their number in any part of it.
class Occupancy {
public:
    explicit Occupancy(const Corner& size)
        : size_(size), sums_((size[0] + std::size_t{1}) * (size[1] + 1) * (size[2] + 1)) {}

    void fill(const Corner& at) { ++sums_[index(at[0] + 1, at[1] + 1, at[2] + 1)]; }
    /// Call it after the last fill: turns entries into counts of all cells below them.
    void sum() {
        for (std::uint32_t z = 1; z <= size_[2]; ++z)
            for (std::uint32_t y = 1; y <= size_[1]; ++y)
                for (std::uint32_t x = 1; x <= size_[0]; ++x)
                    sums_[index(x, y, z)] += below(x - 1, y, z) + below(x, y - 1, z) + below(x, y, z - 1) -
                                             below(x - 1, y - 1, z) - below(x - 1, y, z - 1) - below(x, y - 1, z - 1) +
                                             below(x - 1, y - 1, z - 1);
    }
    const Corner& size() const { return size_; }

    /// Number of filled cells in the cube of this side from a cell, inclusive, towards an octant.
    int filledTowards(const Corner& at, std::uint32_t octant, std::uint32_t cells) const {
        Corner lo = at, hi = at;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lo[axis] = octant >> axis & 1 ? at[axis] : at[axis] + 1 - std::min(cells, at[axis] + 1);
            hi[axis] = octant >> axis & 1 ? std::min(at[axis] + cells, size_[axis]) : at[axis] + 1;
        }
        return below(hi[0], hi[1], hi[2]) - below(lo[0], hi[1], hi[2]) - below(hi[0], lo[1], hi[2]) -
               below(hi[0], hi[1], lo[2]) + below(lo[0], lo[1], hi[2]) + below(lo[0], hi[1], lo[2]) +
               below(hi[0], lo[1], lo[2]) - below(lo[0], lo[1], lo[2]);
    }
    bool filled(const Corner& at) const { return filledTowards(at, 7, 1) > 0; }
    /// Side of the largest empty cube, limited to the range of skips.
    std::uint32_t emptyTowards(const Corner& at, std::uint32_t octant) const {
        std::uint32_t cells = 0;
        while (cells < kMaxSkipped && filledTowards(at, octant, cells + 1) == 0) ++cells;
        return cells;
    }

private:
    std::size_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        return (std::size_t{z} * (size_[1] + 1) + y) * (size_[0] + 1) + x;
    }
    int below(std::uint32_t x, std::uint32_t y, std::uint32_t z) const { return sums_[index(x, y, z)]; }

    Corner size_;
    std::vector<int> sums_;
};

template <typename Visit>
void forCells(const Corner& size, const Visit& visit) {
    Corner at;
    for (at[2] = 0; at[2] < size[2]; ++at[2])
        for (at[1] = 0; at[1] < size[1]; ++at[1])
            for (at[0] = 0; at[0] < size[0]; ++at[0]) visit(at);
}

std::uint32_t codeOf(std::uint32_t word, std::uint32_t octant) {
    return word >> (PRO_SKIP_BITS * octant) & PRO_SKIP_MASK;
}

/// A code as the shaders decode it: 4 to 7 mean quarters, and so on by powers of two.
float cellsOf(std::uint32_t code) {
    if (code == 15) return 28;
    return std::ldexp(static_cast<float>(4 + (code - 1) % 4), static_cast<int>((code - 1) / 4) - 2);
}

std::uint32_t& wordAt(EntryGrid& grid, const Corner& at) {
    return grid.words[(std::size_t{at[2]} * grid.size[1] + at[1]) * grid.size[0] + at[0]];
}

/// A grid with the words of its bricks.
struct Field {
    EntryGrid grid;
    std::vector<Corner> corners;
    Words words;
};

std::uint32_t& wordOfCell(Field& field, const Corner& fine) {
    const std::uint32_t grid_word =
        wordAt(field.grid, {fine[0] / PRO_BRICK_SIDE, fine[1] / PRO_BRICK_SIDE, fine[2] / PRO_BRICK_SIDE});
    const std::uint32_t cell = fine[0] % PRO_BRICK_SIDE + PRO_BRICK_SIDE * (fine[1] % PRO_BRICK_SIDE) +
                               PRO_BRICK_SIDE * PRO_BRICK_SIDE * (fine[2] % PRO_BRICK_SIDE);
    return field.words[(grid_word >> PRO_GRID_BRICK_SHIFT) * PRO_BRICK_WORDS + cell];
}

Occupancy filledGridCells(Field& field) {
    Occupancy filled(field.grid.size);
    forCells(field.grid.size, [&](const Corner& at) {
        if (isFilled(wordAt(field.grid, at))) filled.fill(at);
    });
    filled.sum();
    return filled;
}

Occupancy filledBrickCells(Field& field) {
    const Corner& size = field.grid.size;
    Occupancy filled({size[0] * PRO_BRICK_SIDE, size[1] * PRO_BRICK_SIDE, size[2] * PRO_BRICK_SIDE});
    forCells(filled.size(), [&](const Corner& fine) {
        const Corner at{fine[0] / PRO_BRICK_SIDE, fine[1] / PRO_BRICK_SIDE, fine[2] / PRO_BRICK_SIDE};
        if (isFilled(wordAt(field.grid, at)) && isFilled(wordOfCell(field, fine))) filled.fill(fine);
    });
    filled.sum();
    return filled;
}

/// Skips of all empty cells of all bricks.
struct SkipReport {
    std::uint64_t words = 0, too_large = 0, zeros = 0; ///< counted per octant
    std::uint64_t short_of_best = 0;                   ///< codes below that of the largest empty cube
    double claimed = 0, best = 0;                      ///< sums, in cells
};

SkipReport inspectBricks(Field& field) {
    const Occupancy filled = filledBrickCells(field);
    SkipReport report;
    forCells(filled.size(), [&](const Corner& fine) {
        const Corner at{fine[0] / PRO_BRICK_SIDE, fine[1] / PRO_BRICK_SIDE, fine[2] / PRO_BRICK_SIDE};
        if (!isFilled(wordAt(field.grid, at)) || filled.filled(fine)) return;
        for (std::uint32_t octant = 0; octant < 8; ++octant) {
            const std::uint32_t code = codeOf(wordOfCell(field, fine), octant);
            const std::uint32_t best = filled.emptyTowards(fine, octant);
            ++report.words;
            report.zeros += code == 0;
            // a cell counts as skipped as soon as a part of it is
            report.too_large +=
                filled.filledTowards(fine, octant, static_cast<std::uint32_t>(std::ceil(cellsOf(code)))) > 0;
            report.short_of_best += code < skipCode(best);
            report.claimed += cellsOf(code);
            report.best += cellsOf(skipCode(best));
        }
    });
    return report;
}

/// Skips of the empty grid cells, which may end inside bricks.
SkipReport inspectGrid(Field& field) {
    const Occupancy filled = filledBrickCells(field);
    SkipReport report;
    forCells(field.grid.size, [&](const Corner& at) {
        const std::uint32_t word = wordAt(field.grid, at);
        for (std::uint32_t octant = 0; octant < 8 && !isFilled(word); ++octant) {
            Corner first;
            for (std::size_t axis = 0; axis < 3; ++axis)
                first[axis] = at[axis] * PRO_BRICK_SIDE + (octant >> axis & 1 ? 0 : PRO_BRICK_SIDE - 1);
            const std::uint32_t code = codeOf(word, octant),
                                best = skipCode(0.25f * filled.emptyTowards(first, octant));
            ++report.words;
            report.zeros += code == 0;
            report.too_large +=
                filled.filledTowards(first, octant, static_cast<std::uint32_t>(PRO_BRICK_SIDE * cellsOf(code))) > 0;
            report.short_of_best += code < best;
        }
    });
    return report;
}

void expectExactGrid(Field& field) {
    const Occupancy filled = filledGridCells(field);
    std::uint64_t wrong = 0;
    forCells(field.grid.size, [&](const Corner& at) {
        const std::uint32_t word = wordAt(field.grid, at);
        for (std::uint32_t octant = 0; octant < 8 && !filled.filled(at); ++octant) {
            const auto cells = static_cast<std::uint32_t>(std::ceil(cellsOf(codeOf(word, octant))));
            wrong += cells == 0 || filled.filledTowards(at, octant, cells) > 0;
            wrong += codeOf(word, octant) != skipCode(filled.emptyTowards(at, octant));
        }
    });
    EXPECT_EQ(wrong, 0u);
}

/// Random grid cells, away from the corner of the cube, with a random fraction of filled cells in their bricks, at
/// least one.
Field randomField(const Corner& size, double grid_share, double cell_share, unsigned seed) {
    std::mt19937 random(seed);
    std::bernoulli_distribution has_brick(grid_share), has_list(cell_share);
    std::uniform_int_distribution<std::uint32_t> any_cell(0, PRO_BRICK_WORDS - 1);
    Field field;
    field.grid.shift = 12;
    field.grid.origin = {5, 17, 3};
    field.grid.size = size;
    forCells(size, [&](const Corner& at) {
        if (!has_brick(random)) return;
        Corner corner;
        for (std::size_t axis = 0; axis < 3; ++axis)
            corner[axis] = (at[axis] + field.grid.origin[axis]) << field.grid.shift;
        field.corners.push_back(corner);
    });
    std::shuffle(field.corners.begin(), field.corners.end(), random);
    std::uint32_t cells = 0;
    for (std::size_t k = 0; k < field.corners.size(); ++k) {
        for (std::uint32_t c = 0; c < PRO_BRICK_WORDS; ++c)
            field.words.push_back(has_list(random) ? cells++ << PRO_CELL_INDEX_SHIFT : kEmptyWord);
        field.words[k * PRO_BRICK_WORDS + any_cell(random)] = cells++ << PRO_CELL_INDEX_SHIFT;
    }
    return field;
}

void fillSkips(Field& field) {
    fillEntryGrid(field.grid, field.corners);
    fillCellSkips(field.grid, field.corners.size(), field.words);
}

Field fieldOf(Scene scene) {
    const pro_view view = scene.view();
    Field field;
    field.grid = frameEntryGrid(scene.info, view);
    Bricks bricks = buildBricks(scene.info, view, field.grid);
    field.corners = std::move(bricks.corners);
    field.words = std::move(bricks.words);
    return field;
}

pro_splat disc(float x, float y, float z, float radius) {
    return {{x, y, z}, {0.36f, 0.48f, 0.8f}, radius, {255, 255, 255}, 0};
}

/// side^2 discs on a tilted square in the middle of the cube, and optionally a heap of a quarter as many, 250 times as
/// dense.
Scene sheetScene(std::size_t side, bool heap) {
    std::vector<pro_splat> splats;
    const float spacing = 0.5f / static_cast<float>(side);
    for (std::size_t j = 0; j < side; ++j)
        for (std::size_t i = 0; i < side; ++i) {
            const float u = 0.25f + spacing * static_cast<float>(i), v = 0.25f + spacing * static_cast<float>(j);
            splats.push_back(disc(u, v, 0.7f - 0.45f * u - 0.6f * v + 0.2f, 0.8f * spacing));
            if (heap && i % 2 == 0 && j % 2 == 0)
                splats.push_back(disc(0.3f + u / 250, 0.3f + v / 250, 0.9f + u / 250, 0.8f * spacing / 250));
        }
    test::TreeOptions options;
    options.radius_step = 0.0625f; // 16 octaves
    options.max_depth = 18;
    return sceneOf(std::move(splats), options);
}

TEST(SkipCode, IsTheLargestCodeThatFits) {
    for (float cells = 1; cells <= 30; cells += 0.25f) {
        std::uint32_t largest = 1;
        for (std::uint32_t code = 1; code <= PRO_SKIP_MASK; ++code)
            if (cellsOf(code) <= cells) largest = code;
        EXPECT_EQ(skipCode(cells), largest) << cells;
    }
}

TEST(SkipCode, HasKnownValues) {
    constexpr std::array<float, 16> kCells{0, 1, 1.25, 1.5, 1.75, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 10, 28};
    for (std::uint32_t code = 1; code <= PRO_SKIP_MASK; ++code) {
        EXPECT_EQ(skippedCells(code), kCells[code]) << code;
        EXPECT_EQ(skipCode(kCells[code]), code) << code;
        EXPECT_EQ(cellsOf(code), kCells[code]) << code;
    }
    EXPECT_EQ(skipCode(9.75f), 13u);
    EXPECT_EQ(skipCode(27), 14u);
    EXPECT_EQ(skipCode(1000), 15u);
}

TEST(EntryGrid, HasTheDepthOfMostSplats) {
    Scene scene = test::tinyScene(); // 3 splats at depth 1, 2 at depth 2; leaves at both ends of each axis
    const EntryGrid grid = frameEntryGrid(scene.info, scene.view());
    EXPECT_EQ(grid.shift, PRO_POSITION_BITS - 1);
    EXPECT_EQ(grid.origin, (Corner{0, 0, 0}));
    EXPECT_EQ(grid.size, (Corner{2, 2, 2}));
    EXPECT_TRUE(grid.words.empty());
    EXPECT_TRUE(grid.uneven); // a ray would test (3 + 2 * (5.6 / 3.6)^2) / 5 = 1.57 times as many discs
}

TEST(EntryGrid, CoversOnlyTheLeaves) {
    Scene scene = sceneOf({disc(0.55f, 0.55f, 0.3f, 0.01f), disc(0.6f, 0.55f, 0.3f, 0.01f),
                           disc(0.95f, 0.55f, 0.3f, 0.01f), disc(0.9f, 0.6f, 0.3f, 0.01f)},
                          {2, 4, 0.5f, 0.25f, 0.03125f});
    // leaves at depth 2 in the row x 2 to 3, y 2, z 1: at depth 1 all four share a cell
    const EntryGrid grid = frameEntryGrid(scene.info, scene.view());
    EXPECT_EQ(grid.shift, PRO_POSITION_BITS - 2);
    EXPECT_EQ(grid.origin, (Corner{2, 2, 1}));
    EXPECT_EQ(grid.size, (Corner{2, 1, 1}));
    EXPECT_FALSE(grid.uneven);
}

TEST(EntryGrid, NamesTheBricksAndSkipsEmptyCells) {
    for (const double share : {0.3, 0.03, 0.001}) {
        Field field = randomField({37, 9, 22}, share, 0.5, 3);
        fillEntryGrid(field.grid, field.corners);
        ASSERT_FALSE(field.corners.empty());
        for (std::size_t k = 0; k < field.corners.size(); ++k) {
            Corner at = field.corners[k];
            for (std::size_t axis = 0; axis < 3; ++axis)
                at[axis] = (at[axis] >> field.grid.shift) - field.grid.origin[axis];
            EXPECT_EQ(wordAt(field.grid, at), k << PRO_GRID_BRICK_SHIFT);
        }
        std::size_t filled = 0;
        for (const std::uint32_t word : field.grid.words) filled += isFilled(word);
        EXPECT_EQ(filled, field.corners.size());
        expectExactGrid(field);
    }
}

TEST(EntryGrid, SkipsByOctant) {
    EntryGrid grid;
    grid.shift = 4;
    grid.size = {40, 1, 1};
    fillEntryGrid(grid, std::vector<Corner>{{20 << 4, 0, 0}});
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
        const bool rises = octant & 1;
        EXPECT_EQ(codeOf(grid.words[19], octant), rises ? 1u : 15u);
        EXPECT_EQ(codeOf(grid.words[21], octant), rises ? 15u : 1u);
        EXPECT_EQ(codeOf(grid.words[10], octant), rises ? 14u : 15u); // 10 empty ones
        EXPECT_EQ(codeOf(grid.words[11], octant), rises ? 13u : 15u); // 9 hold 8
        EXPECT_EQ(codeOf(grid.words[39], octant), rises ? 15u : 14u); // 19 hold 10, not 28
    }
    EXPECT_EQ(grid.words[20], 0u);
}

TEST(CellSkips, AreExactAroundOneDisc) {
    Field field = fieldOf(sceneOf({disc(0.375f, 0.375f, 0.375f, 0.05f)}));
    ASSERT_EQ(field.words.size(), PRO_BRICK_WORDS);
    fillSkips(field);
    EXPECT_EQ(field.words[1 + 4 + 16], 0u);   // the only list of splats
    EXPECT_EQ(codeOf(field.words[0], 7), 1u); // next to it
    EXPECT_EQ(field.words[0] >> 4 * 7, 1u);   // towards that octant alone
    EXPECT_EQ(field.words[0] & 0x0FFFFFFFu, 0x0FFFFFFFu);
    EXPECT_EQ(field.words[63], 0xFFFFFFF5u);         // two cells away
    EXPECT_EQ(field.words[3 + 4 + 16], 0xF5F5F5F5u); // towards decreasing x
    const SkipReport report = inspectBricks(field);
    EXPECT_EQ(report.words, 63u * 8);
    EXPECT_EQ(report.too_large + report.zeros + report.short_of_best, 0u);
}

TEST(CellSkips, AreOptimalInAFullGrid) {
    for (const double share : {0.2, 0.01, 0.0}) {
        Field field = randomField({9, 11, 8}, 1, share, 5);
        fillSkips(field);
        const SkipReport report = inspectBricks(field);
        EXPECT_GT(report.words, 100'000u);
        EXPECT_EQ(report.too_large + report.zeros + report.short_of_best, 0u);
    }
}

TEST(CellSkips, AreConservativeInASparseGrid) {
    for (const double share : {0.5, 0.1, 0.01}) {
        Field field = randomField({19, 11, 14}, share, 0.05, 7);
        fillSkips(field);
        const SkipReport report = inspectBricks(field), of_grid = inspectGrid(field);
        EXPECT_GT(report.words, 5'000u);
        EXPECT_EQ(report.too_large, 0u);
        EXPECT_EQ(report.zeros, 0u);
        EXPECT_EQ(of_grid.too_large + of_grid.zeros + of_grid.short_of_best, 0u);
        EXPECT_GT(report.claimed, 0.9 * report.best); // far from bricks, grid words are not optimal
    }
}

TEST(CellSkips, ExtendGridCellsIntoBricks) {
    EntryGrid grid;
    grid.shift = 4;
    grid.size = {5, 1, 1};
    fillEntryGrid(grid, std::vector<Corner>{{2 << 4, 0, 0}});
    Words words(PRO_BRICK_WORDS, kEmptyWord);
    words[2 + 4 * 3 + 16 * 1] = 0; // its third layer in x, the last in y
    fillCellSkips(grid, 1, words);
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
        const bool rises = octant & 1;
        EXPECT_EQ(cellsOf(codeOf(grid.words[1], octant)), rises ? 1.5f : 28.0f);
        EXPECT_EQ(cellsOf(codeOf(grid.words[0], octant)), rises ? 2.5f : 28.0f);
        EXPECT_EQ(cellsOf(codeOf(grid.words[3], octant)), rises ? 28.0f : 1.25f);
        EXPECT_EQ(cellsOf(codeOf(grid.words[4], octant)), rises ? 28.0f : 2.0f); // 9 quarters
    }
    EXPECT_EQ(grid.words[2], 0u);
}

TEST(CellSkips, KeepListedCellsAndGroups) {
    Field field = randomField({5, 4, 3}, 0.4, 0.3, 11);
    const std::vector<std::uint32_t> groups{7 << PRO_CELL_INDEX_SHIFT,
                                            kEmptyWord,
                                            1 << PRO_CELL_INDEX_SHIFT | PRO_CELL_INNER,
                                            kEmptyWord,
                                            kEmptyWord,
                                            kEmptyWord,
                                            kEmptyWord,
                                            kEmptyWord};
    field.words[1] = PRO_CELL_INNER;
    const Words before = field.words;
    field.words.insert(field.words.end(), groups.begin(), groups.end());
    fillSkips(field);
    for (std::size_t w = 0; w < before.size(); ++w) {
        EXPECT_EQ(isFilled(field.words[w]), isFilled(before[w]));
        EXPECT_TRUE(!isFilled(before[w]) || field.words[w] == before[w]);
    }
    EXPECT_TRUE(std::equal(groups.begin(), groups.end(), field.words.end() - PRO_GROUP_WORDS));
}

TEST(CellSkips, AreConservativeInScenes) {
    for (const bool heap : {false, true}) {
        Field field = fieldOf(sheetScene(50, heap));
        EXPECT_TRUE(!heap || field.words.size() > field.corners.size() * PRO_BRICK_WORDS); // has groups of halves
        fillSkips(field);
        const SkipReport report = inspectBricks(field), of_grid = inspectGrid(field);
        EXPECT_GT(report.words, 10'000u);
        EXPECT_EQ(of_grid.too_large + of_grid.zeros + of_grid.short_of_best, 0u);
        EXPECT_EQ(report.too_large, 0u);
        EXPECT_EQ(report.zeros, 0u);
        EXPECT_GT(report.claimed, 0.95 * report.best);
    }
}

} // namespace
} // namespace pointrt
