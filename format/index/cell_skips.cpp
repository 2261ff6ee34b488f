// SPDX-License-Identifier: Apache-2.0
#include "format/index/cell_skips.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "format/base/parallel.h"
#include "pointrt/pro_index_layout.h"

namespace pointrt {

namespace {

using Index = std::array<std::uint32_t, 3>;

/// The cells of a brick and its neighbours towards the octant; x fastest, indexed in the directions of the octant.
constexpr std::uint32_t kBlockSide = PRO_BRICK_SIDE + 1;
using Block = std::array<std::uint8_t, kBlockSide * kBlockSide * kBlockSide>;

std::uint32_t blockIndex(const Index& at) { return (at[2] * kBlockSide + at[1]) * kBlockSide + at[0]; }

/// Grid cells with a larger empty cube keep it: extending it by part of a cell would gain little.
constexpr float kNearBricks = 3;
constexpr std::uint32_t kNoBlock = ~0u;

/// Skips towards one octant, in edges of brick cells.
struct Skips {
    std::vector<std::uint8_t> of_words; ///< PRO_BRICK_WORDS per brick; 0 for filled cells
    std::vector<std::uint8_t> of_grid;  ///< one per grid cell, for empty ones
};

/// Computes skips towards one octant. Empty grid cells near bricks are treated as bricks.
class OctantSkips {
public:
    OctantSkips(const EntryGrid& grid, std::size_t brick_count, const Words& words, std::uint32_t octant)
        : grid_(grid), words_(words), octant_(octant), brick_count_(static_cast<std::uint32_t>(brick_count)),
          blocks_(grid.words.size(), kNoBlock), reach_(grid.words.size()) {
        std::uint32_t count = brick_count_;
        for (std::size_t c = 0; c < blocks_.size(); ++c) {
            const std::uint32_t word = grid.words[c];
            const bool filled = (word & PRO_SKIP_MASK) == 0;
            const float cells = filled ? 0 : skippedCells(word >> (PRO_SKIP_BITS * octant) & PRO_SKIP_MASK);
            reach_[c] = static_cast<std::uint8_t>(cells * PRO_BRICK_SIDE);
            if (filled)
                blocks_[c] = word >> PRO_GRID_BRICK_SHIFT;
            else if (cells <= kNearBricks)
                blocks_[c] = count++;
        }
        skips_.resize(std::size_t{count} * PRO_BRICK_WORDS);
    }

    Skips run() {
        // from the octant's far corner inwards, so that the neighbours of a block are done before it
        Index cell;
        for (std::uint32_t k = 0; k < grid_.size[2]; ++k)
            for (std::uint32_t j = 0; j < grid_.size[1]; ++j)
                for (std::uint32_t i = 0; i < grid_.size[0]; ++i) {
                    cell = {inwards(0, i), inwards(1, j), inwards(2, k)};
                    if (blocks_[indexOf(cell)] != kNoBlock) fillBlock(cell, indexOf(cell));
                }
        skips_.resize(std::size_t{brick_count_} * PRO_BRICK_WORDS);
        skips_.shrink_to_fit(); // all eight octants are kept until the end
        return {std::move(skips_), std::move(reach_)};
    }

private:
    bool rises(std::uint32_t axis) const { return octant_ >> axis & 1; }
    std::uint32_t inwards(std::uint32_t axis, std::uint32_t i) const {
        return rises(axis) ? grid_.size[axis] - 1 - i : i;
    }
    std::size_t indexOf(const Index& cell) const {
        return (std::size_t{cell[2]} * grid_.size[1] + cell[1]) * grid_.size[0] + cell[0];
    }

    /// The word of a cell of a block, indexed in the directions of the octant.
    std::size_t wordOf(std::uint32_t block, const Index& at) const {
        std::size_t word = 0;
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            word |= std::size_t{rises(axis) ? at[axis] : PRO_BRICK_SIDE - 1 - at[axis]} << (PRO_BRICK_BITS * axis);
        return std::size_t{block} * PRO_BRICK_WORDS + word;
    }

    void fillBlock(const Index& cell, std::size_t grid_index) {
        const std::uint32_t number = blocks_[grid_index];
        Block block;
        for (std::uint32_t side = 1; side < 8; ++side) copyRim(cell, side, block);
        Index at;
        for (at[2] = PRO_BRICK_SIDE; at[2]-- > 0;)
            for (at[1] = PRO_BRICK_SIDE; at[1]-- > 0;)
                for (at[0] = PRO_BRICK_SIDE; at[0]-- > 0;) {
                    const std::size_t word = wordOf(number, at);
                    const bool filled = number < brick_count_ && (words_[word] & PRO_SKIP_MASK) == 0;
                    block[blockIndex(at)] = skips_[word] = filled ? std::uint8_t{0} : skipFrom(block, blockIndex(at));
                }
        if (number >= brick_count_) reach_[grid_index] = std::max(reach_[grid_index], block[0]);
    }

    /// As in the grid: 1 + the minimum over the 7 neighbours towards the octant.
    static std::uint8_t skipFrom(const Block& block, std::uint32_t at) {
        constexpr std::uint32_t y = kBlockSide, z = kBlockSide * kBlockSide;
        const std::uint8_t* p = block.data() + at;
        const std::uint8_t least = std::min({p[1], p[y], p[1 + y], p[z], p[1 + z], p[y + z], p[1 + y + z]});
        return std::min<std::uint8_t>(kMaxSkipped, least + 1);
    }

    /// Copies the skips of a neighbouring grid cell to the rim of the block. @param side its axes (bit 0: x, ...)
    void copyRim(const Index& cell, std::uint32_t side, Block& block) const {
        Index beyond = cell, first{}, last{};
        bool outside = false;
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const bool crossed = side >> axis & 1;
            outside |= crossed && cell[axis] == (rises(axis) ? grid_.size[axis] - 1 : 0);
            beyond[axis] = crossed ? cell[axis] + (rises(axis) ? 1u : ~0u) : cell[axis];
            first[axis] = crossed ? PRO_BRICK_SIDE : 0;
            last[axis] = crossed ? PRO_BRICK_SIDE : PRO_BRICK_SIDE - 1;
        }
        const std::uint32_t other = outside ? kNoBlock : blocks_[indexOf(beyond)];
        const std::uint32_t reach = outside ? kMaxSkipped * PRO_BRICK_SIDE : reach_[indexOf(beyond)];
        Index at;
        for (at[2] = first[2]; at[2] <= last[2]; ++at[2])
            for (at[1] = first[1]; at[1] <= last[1]; ++at[1])
                for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) {
                    const Index inside{at[0] % PRO_BRICK_SIDE, at[1] % PRO_BRICK_SIDE, at[2] % PRO_BRICK_SIDE};
                    if (other != kNoBlock) {
                        block[blockIndex(at)] = skips_[wordOf(other, inside)];
                        continue;
                    }
                    // the rest of the empty cube beyond this cell
                    const std::uint32_t left = reach - std::max({inside[0], inside[1], inside[2]});
                    block[blockIndex(at)] = static_cast<std::uint8_t>(std::min<std::uint32_t>(kMaxSkipped, left));
                }
    }

    const EntryGrid& grid_;
    const Words& words_;
    std::uint32_t octant_, brick_count_;
    std::vector<std::uint32_t> blocks_; ///< per grid cell: its brick, or a number from brick_count_ on, or kNoBlock
    std::vector<std::uint8_t> reach_;   ///< per grid cell, for empty ones
    std::vector<std::uint8_t> skips_;   ///< PRO_BRICK_WORDS per block; 0 for filled cells
};

} // namespace

void fillCellSkips(EntryGrid& grid, std::size_t brick_count, Words& words, std::size_t threads) {
    std::array<Skips, 8> skips;
    const auto fillOctant = [&](std::size_t octant) {
        skips[octant] = OctantSkips(grid, brick_count, words, static_cast<std::uint32_t>(octant)).run();
    };
    forAll(8, fillOctant, threads);
    for (std::size_t w = 0; w < brick_count * PRO_BRICK_WORDS; ++w)
        writeSkips(words[w], [&](std::uint32_t octant) { return static_cast<float>(skips[octant].of_words[w]); });
    for (std::size_t c = 0; c < grid.words.size(); ++c)
        writeSkips(grid.words[c],
                   [&](std::uint32_t octant) { return static_cast<float>(skips[octant].of_grid[c]) / PRO_BRICK_SIDE; });
}

} // namespace pointrt
