// SPDX-License-Identifier: Apache-2.0
#include "runtime/entry_grid.h"

#include <algorithm>
#include <array>
#include <future>

#include "runtime/node_walk.h"
#include "shaders/brick_layout.h"

namespace pointrt {

namespace {

constexpr std::uint8_t kSkipMax = 15;

/// The grid takes the depth of most leaves, so that rays seldom walk from it down, unless it had more words than this
/// for each leaf: 2 bytes a splat of an even scan, 20 of the least even one tried.
constexpr std::uint64_t kWordsPerLeaf = 32;
constexpr std::uint64_t kWordsLeast = 1u << 15;
constexpr std::uint64_t kWordsMost = 1u << 22; ///< 16 MiB: beyond, the grid itself no longer fits into caches

std::uint32_t commonLeafDepth(std::span<const std::uint32_t> nodes) {
    std::array<std::uint32_t, PRO_MAX_DEPTH + 1> leaves{};
    forNodes(nodes, PRO_MAX_DEPTH,
             [&](std::uint32_t, const Corner&, std::uint32_t shift) { ++leaves[PRO_POSITION_BITS - shift]; });
    return static_cast<std::uint32_t>(std::max_element(leaves.begin(), leaves.end()) - leaves.begin());
}

/// A grid without words over the leaves' bounds.
EntryGrid frameGrid(std::span<const std::uint32_t> nodes, std::uint32_t depth) {
    constexpr std::uint32_t kNone = ~0u;
    Corner lo{kNone, kNone, kNone}, hi{};
    EntryGrid grid;
    grid.shift = PRO_POSITION_BITS - depth;
    forNodes(nodes, depth, [&](std::uint32_t, const Corner& corner, std::uint32_t shift) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lo[axis] = std::min(lo[axis], corner[axis]);
            hi[axis] = std::max(hi[axis], corner[axis] + (1u << shift));
        }
    });
    for (std::size_t axis = 0; axis < 3; ++axis) {
        grid.origin[axis] = lo[axis] >> grid.shift;
        grid.size[axis] = (hi[axis] - lo[axis]) >> grid.shift;
    }
    return grid;
}

std::uint64_t wordCount(const EntryGrid& grid) { return std::uint64_t{grid.size[0]} * grid.size[1] * grid.size[2]; }

EntryGrid chooseGrid(std::span<const std::uint32_t> nodes, std::uint32_t leaf_count) {
    const std::uint64_t most = std::clamp(kWordsPerLeaf * leaf_count, kWordsLeast, kWordsMost);
    std::uint32_t depth = commonLeafDepth(nodes);
    EntryGrid grid = frameGrid(nodes, depth);
    while (wordCount(grid) > most) grid = frameGrid(nodes, --depth); // ends: at depth 0 there is one word
    return grid;
}

void paint(EntryGrid& grid, std::uint32_t node, const Corner& corner, std::uint32_t shift) {
    const std::uint32_t side = 1u << (shift - grid.shift);
    const std::uint32_t word = node & PRO_NODE_INNER ? (node & PRO_NODE_GROUP_MASK) << GRID_INDEX_SHIFT
                                                     : (node - 1) << GRID_INDEX_SHIFT | GRID_LEAF;
    std::array<std::size_t, 3> from;
    for (std::size_t axis = 0; axis < 3; ++axis) from[axis] = (corner[axis] >> grid.shift) - grid.origin[axis];
    for (std::size_t z = from[2]; z < from[2] + side; ++z)
        for (std::size_t y = from[1]; y < from[1] + side; ++y) {
            const std::size_t row = (z * grid.size[1] + y) * grid.size[0] + from[0];
            std::fill_n(grid.words.begin() + static_cast<std::ptrdiff_t>(row), side, word);
        }
}

/// Largest empty cube from each cell towards one octant, by the recurrence 1 + minimum over the 7 neighbours there.
std::vector<std::uint8_t> skipsTowards(const std::vector<char>& filled, const EntryGrid& grid, std::uint32_t octant) {
    // a border of empty cells around the grid saves asking where it ends
    const std::array<std::size_t, 3> size{grid.size[0] + 2u, grid.size[1] + 2u, grid.size[2] + 2u};
    std::vector<std::uint8_t> padded(size[0] * size[1] * size[2], kSkipMax), skips(filled.size());
    const std::array<std::ptrdiff_t, 3> stride{1, static_cast<std::ptrdiff_t>(size[0]),
                                               static_cast<std::ptrdiff_t>(size[0] * size[1])};
    std::ptrdiff_t toward[3];
    for (std::uint32_t axis = 0; axis < 3; ++axis) toward[axis] = octant >> axis & 1 ? stride[axis] : -stride[axis];
    const auto from = [&](std::uint32_t axis, std::uint32_t i) { // from the octant's far corner inwards
        return octant >> axis & 1 ? grid.size[axis] - 1 - i : i;
    };
    for (std::uint32_t k = 0; k < grid.size[2]; ++k)
        for (std::uint32_t j = 0; j < grid.size[1]; ++j)
            for (std::uint32_t i = 0; i < grid.size[0]; ++i) {
                const std::size_t x = from(0, i), y = from(1, j), z = from(2, k);
                const std::size_t cell = (z * grid.size[1] + y) * grid.size[0] + x;
                std::uint8_t* at = padded.data() + ((z + 1) * size[1] + y + 1) * size[0] + x + 1;
                const std::ptrdiff_t dx = toward[0], dy = toward[1], dz = toward[2];
                const std::uint8_t nearest =
                    std::min({at[dx], at[dy], at[dz], at[dx + dy], at[dx + dz], at[dy + dz], at[dx + dy + dz]});
                *at = filled[cell] ? std::uint8_t{0} : std::min<std::uint8_t>(kSkipMax, nearest + 1);
                skips[cell] = *at;
            }
    return skips;
}

} // namespace

EntryGrid buildEntryGrid(std::span<const std::uint32_t> nodes, std::uint32_t leaf_count) {
    constexpr std::uint32_t kUnset = GRID_EMPTY_MASK; // no node word ends in it
    EntryGrid grid = chooseGrid(nodes, leaf_count);
    grid.words.assign(wordCount(grid), kUnset);
    forNodes(nodes, PRO_POSITION_BITS - grid.shift,
             [&](std::uint32_t node, const Corner& corner, std::uint32_t shift) { paint(grid, node, corner, shift); });

    std::vector<char> filled(grid.words.size());
    for (std::size_t c = 0; c < filled.size(); ++c) filled[c] = grid.words[c] != kUnset;
    std::array<std::future<std::vector<std::uint8_t>>, 8> work;
    for (std::uint32_t octant = 0; octant < 8; ++octant)
        work[octant] = std::async(std::launch::async, [&, octant] { return skipsTowards(filled, grid, octant); });
    std::array<std::vector<std::uint8_t>, 8> skips;
    for (std::uint32_t octant = 0; octant < 8; ++octant) skips[octant] = work[octant].get();
    for (std::size_t c = 0; c < filled.size(); ++c) {
        if (filled[c]) continue;
        grid.words[c] = 0;
        for (std::uint32_t octant = 0; octant < 8; ++octant)
            grid.words[c] |= static_cast<std::uint32_t>(skips[octant][c]) << (4 * octant);
    }
    return grid;
}

} // namespace pointrt
