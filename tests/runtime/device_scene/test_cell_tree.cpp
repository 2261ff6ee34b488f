// SPDX-License-Identifier: Apache-2.0
// The boxes of an index's cells, for ray queries.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "pointrt/pro_index_layout.h"
#include "runtime/device_scene/cell_tree.h"

namespace pointrt {
namespace {

constexpr std::uint32_t kEmptyWord = 0x11111111;
constexpr std::uint32_t cellWord(std::uint32_t cell) { return cell << PRO_CELL_INDEX_SHIFT; }
constexpr std::uint32_t groupWord(std::uint32_t group) { return group << PRO_CELL_INDEX_SHIFT | PRO_CELL_INNER; }

/// Two grid cells along x; the second has a brick, and after it comes a group.
struct SmallIndex {
    std::array<std::uint32_t, 2> grid{kEmptyWord, 0};
    std::vector<std::uint32_t> bricks = std::vector<std::uint32_t>(PRO_BRICK_WORDS + PRO_GROUP_WORDS, kEmptyWord);
    std::uint32_t group = PRO_BRICK_WORDS / PRO_GROUP_WORDS; ///< its number

    pro_index view(std::uint32_t cells) const {
        pro_index index{};
        index.size[0] = 2;
        index.size[1] = index.size[2] = 1;
        index.brick_count = index.group_count = 1;
        index.cell_count = cells;
        index.grid = grid.data();
        index.bricks = bricks.data();
        return index;
    }
};

void expectCell(const gpu::vec4& cell, float x, float y, float z, float edge) {
    EXPECT_EQ((std::array{cell.x, cell.y, cell.z, cell.w}), (std::array{x, y, z, edge}));
}

TEST(CellTree, Cells_LieInBricksAndGroups) {
    SmallIndex small;
    small.bricks[1 + 2 * PRO_BRICK_SIDE] = cellWord(0);
    small.bricks[PRO_BRICK_WORDS - 1] = groupWord(small.group);
    small.bricks[PRO_BRICK_WORDS + 5] = cellWord(1); // x and z halves
    const std::vector<gpu::vec4> cells = cellsOf(small.view(3));
    ASSERT_EQ(cells.size(), 3u);
    expectCell(cells[0], 1.375f, 0.625f, 0.125f, 0.25f);
    expectCell(cells[1], 1.9375f, 0.8125f, 0.9375f, 0.125f);
    expectCell(cells[2], 0, 0, 0, 0); // not named by any word
}

TEST(CellTree, Cells_OfDamagedFilesAreSkipped) {
    SmallIndex small;
    small.grid[0] = 7u << PRO_GRID_BRICK_SHIFT;
    small.bricks[0] = cellWord(9);
    small.bricks[1] = groupWord(small.group + 1);
    small.bricks[2] = groupWord(0);
    small.bricks[3] = groupWord(small.group);
    for (std::uint32_t k = 0; k < PRO_GROUP_WORDS; ++k)
        small.bricks[PRO_BRICK_WORDS + k] = groupWord(small.group); // a cycle
    expectCell(cellsOf(small.view(1)).at(0), 0, 0, 0, 0);
}

} // namespace
} // namespace pointrt
