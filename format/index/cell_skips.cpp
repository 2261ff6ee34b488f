// SPDX-License-Identifier: Apache-2.0
#include "format/index/cell_skips.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "format/src/parallel.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt {

namespace {

using Index = std::array<std::uint32_t, 3>;

/// The cells of a brick and those next to it towards the octant; x fastest, counted in the octant's directions.
constexpr std::uint32_t kBlockSide = PRO_BRICK_SIDE + 1;
using Block = std::array<std::uint8_t, kBlockSide * kBlockSide * kBlockSide>;

std::uint32_t blockIndex(const Index& at) { return (at[2] * kBlockSide + at[1]) * kBlockSide + at[0]; }

/// Skips towards one octant.
class OctantSkips {
public:
    OctantSkips(const EntryGrid& grid, std::size_t brick_count, const Words& words, std::uint32_t octant)
        : grid_(grid), words_(words), octant_(octant), skips_(brick_count * PRO_BRICK_WORDS) {}

    /// PRO_BRICK_WORDS for each brick; 0 for filled cells.
    std::vector<std::uint8_t> run() {
        // from the octant's far corner inwards: what a brick needs of others is there before it
        Index cell;
        for (std::uint32_t k = 0; k < grid_.size[2]; ++k)
            for (std::uint32_t j = 0; j < grid_.size[1]; ++j)
                for (std::uint32_t i = 0; i < grid_.size[0]; ++i) {
                    cell = {inwards(0, i), inwards(1, j), inwards(2, k)};
                    const std::uint32_t word = gridWord(cell);
                    if ((word & PRO_SKIP_MASK) == 0) fillBrick(cell, word >> PRO_GRID_BRICK_SHIFT);
                }
        return std::move(skips_);
    }

private:
    bool rises(std::uint32_t axis) const { return octant_ >> axis & 1; }
    std::uint32_t inwards(std::uint32_t axis, std::uint32_t i) const {
        return rises(axis) ? grid_.size[axis] - 1 - i : i;
    }
    std::uint32_t gridWord(const Index& cell) const {
        return grid_.words[(std::size_t{cell[2]} * grid_.size[1] + cell[1]) * grid_.size[0] + cell[0]];
    }

    /// The word of the brick's cell at a place counted in the octant's directions.
    std::size_t wordOf(std::uint32_t brick, const Index& at) const {
        std::size_t word = 0;
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            word |= std::size_t{rises(axis) ? at[axis] : PRO_BRICK_SIDE - 1 - at[axis]} << (2 * axis);
        return std::size_t{brick} * PRO_BRICK_WORDS + word;
    }

    void fillBrick(const Index& cell, std::uint32_t brick) {
        Block block;
        for (std::uint32_t side = 1; side < 8; ++side) borrow(cell, side, block);
        Index at;
        for (at[2] = PRO_BRICK_SIDE; at[2]-- > 0;)
            for (at[1] = PRO_BRICK_SIDE; at[1]-- > 0;)
                for (at[0] = PRO_BRICK_SIDE; at[0]-- > 0;) {
                    const std::size_t word = wordOf(brick, at);
                    const bool filled = (words_[word] & PRO_SKIP_MASK) == 0;
                    block[blockIndex(at)] = skips_[word] = filled ? std::uint8_t{0} : onward(block, blockIndex(at));
                }
    }

    /// 1 and the least of the 7 cells further on, as in the grid.
    static std::uint8_t onward(const Block& block, std::uint32_t at) {
        constexpr std::uint32_t y = kBlockSide, z = kBlockSide * kBlockSide;
        const std::uint8_t* p = block.data() + at;
        const std::uint8_t least = std::min({p[1], p[y], p[1 + y], p[z], p[1 + z], p[y + z], p[1 + y + z]});
        return std::min<std::uint8_t>(PRO_SKIP_CELLS_MAX, least + 1);
    }

    /// Copies the skips of the grid cell beyond by the axes in side (bit 0: x, ...) to the block's rim.
    void borrow(const Index& cell, std::uint32_t side, Block& block) const {
        Index beyond = cell, first{}, last{};
        bool outside = false;
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const bool crossed = side >> axis & 1;
            outside |= crossed && cell[axis] == (rises(axis) ? grid_.size[axis] - 1 : 0);
            beyond[axis] = crossed ? cell[axis] + (rises(axis) ? 1u : ~0u) : cell[axis];
            first[axis] = crossed ? PRO_BRICK_SIDE : 0;
            last[axis] = crossed ? PRO_BRICK_SIDE : PRO_BRICK_SIDE - 1;
        }
        const std::uint32_t word = outside ? ~0u : gridWord(beyond); // outside, every nibble is the largest
        const bool filled = (word & PRO_SKIP_MASK) == 0;
        const std::uint32_t empty_cells = skippedCells(word >> (PRO_SKIP_BITS * octant_) & PRO_SKIP_MASK);
        Index at;
        for (at[2] = first[2]; at[2] <= last[2]; ++at[2])
            for (at[1] = first[1]; at[1] <= last[1]; ++at[1])
                for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) {
                    const Index inside{at[0] % PRO_BRICK_SIDE, at[1] % PRO_BRICK_SIDE, at[2] % PRO_BRICK_SIDE};
                    if (filled) {
                        block[blockIndex(at)] = skips_[wordOf(word >> PRO_GRID_BRICK_SHIFT, inside)];
                        continue;
                    }
                    // of an empty stretch of grid cells, what lies beyond this place in the first of them
                    const std::uint32_t left =
                        empty_cells * PRO_BRICK_SIDE - std::max({inside[0], inside[1], inside[2]});
                    block[blockIndex(at)] =
                        static_cast<std::uint8_t>(std::min<std::uint32_t>(PRO_SKIP_CELLS_MAX, left));
                }
    }

    const EntryGrid& grid_;
    const Words& words_;
    std::uint32_t octant_;
    std::vector<std::uint8_t> skips_;
};

} // namespace

void fillCellSkips(const EntryGrid& grid, std::size_t brick_count, Words& words, std::size_t threads) {
    std::array<std::vector<std::uint8_t>, 8> skips;
    const auto fillOctant = [&](std::size_t octant) {
        skips[octant] = OctantSkips(grid, brick_count, words, static_cast<std::uint32_t>(octant)).run();
    };
    forAll(8, fillOctant, threads);
    const std::size_t count = skips[0].size();
    for (std::size_t w = 0; w < count; ++w) {
        if ((words[w] & PRO_SKIP_MASK) == 0) continue;
        words[w] = 0;
        for (std::uint32_t octant = 0; octant < 8; ++octant)
            words[w] |= std::uint32_t{skipCode(skips[octant][w])} << (PRO_SKIP_BITS * octant);
    }
}

} // namespace pointrt
