// SPDX-License-Identifier: Apache-2.0
#include "runtime/entry_grid.h"

#include <algorithm>
#include <array>
#include <future>

#include "pointrt/pro_layout.h"

namespace pointrt {

namespace {

constexpr std::uint32_t kFilledMask = 15; // low nibble: 0 marks a filled cell
constexpr std::uint32_t kNodeShift = 4;
constexpr std::uint8_t kSkipMax = 15;

/// 64 cells a side cost 1 MiB; above half a million leaves the halved walk from the grid down pays for 8 MiB.
std::uint32_t chooseBits(std::uint32_t leaf_count, std::uint32_t max_depth) {
    return std::min<std::uint32_t>(leaf_count > 500000 ? 7 : 6, max_depth);
}

struct Filler {
    std::span<const std::uint32_t> nodes;
    EntryGrid& grid;

    /// Writes the cells of node index, whose cube of 2^level_bits cells starts at (x, y, z).
    void fill(std::uint32_t index, std::uint32_t level_bits, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        const std::uint32_t node = nodes[index];
        if (node == PRO_NODE_EMPTY) return;
        if (level_bits == 0 || !(node & PRO_NODE_INNER)) return paint(index, 1u << level_bits, x, y, z);
        const std::uint32_t half = level_bits - 1;
        for (std::uint32_t slot = 0; slot < PRO_GROUP_SIZE; ++slot)
            fill((node & PRO_NODE_GROUP_MASK) * PRO_GROUP_SIZE + slot, half, x + ((slot & 1) << half),
                 y + ((slot >> 1 & 1) << half), z + ((slot >> 2) << half));
    }

    void paint(std::uint32_t index, std::uint32_t side, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        for (std::uint32_t k = z; k < z + side; ++k)
            for (std::uint32_t j = y; j < y + side; ++j) {
                const auto row = grid.words.begin() + ((((k << grid.bits) | j) << grid.bits) | x);
                std::fill(row, row + side, index << kNodeShift);
            }
    }
};

/// Largest empty cube from each cell towards one octant, by the recurrence 1 + minimum over the 7 neighbours there.
std::vector<std::uint8_t> skipsTowards(const std::vector<char>& filled, std::uint32_t bits, std::uint32_t octant) {
    const int side = 1 << bits;
    std::vector<std::uint8_t> skips(filled.size());
    const auto at = [&](int x, int y, int z) -> std::uint8_t {
        const bool inside = x >= 0 && y >= 0 && z >= 0 && x < side && y < side && z < side;
        return inside ? skips[static_cast<std::size_t>(((z << bits | y) << bits) | x)] : kSkipMax;
    };
    const int dx = octant & 1 ? 1 : -1, dy = octant & 2 ? 1 : -1, dz = octant & 4 ? 1 : -1;
    for (int k = 0; k < side; ++k)
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) { // from the octant's far corner inwards
                const int x = dx > 0 ? side - 1 - i : i, y = dy > 0 ? side - 1 - j : j, z = dz > 0 ? side - 1 - k : k;
                const auto cell = static_cast<std::size_t>(((z << bits | y) << bits) | x);
                if (filled[cell]) continue;
                const std::uint8_t nearest =
                    std::min({at(x + dx, y, z), at(x, y + dy, z), at(x, y, z + dz), at(x + dx, y + dy, z),
                              at(x + dx, y, z + dz), at(x, y + dy, z + dz), at(x + dx, y + dy, z + dz)});
                skips[cell] = static_cast<std::uint8_t>(std::min<int>(kSkipMax, nearest + 1));
            }
    return skips;
}

} // namespace

EntryGrid buildEntryGrid(std::span<const std::uint32_t> nodes, std::uint32_t leaf_count, std::uint32_t max_depth) {
    constexpr std::uint32_t kUnset = kFilledMask; // no node word ends in it
    EntryGrid grid;
    grid.bits = chooseBits(leaf_count, max_depth);
    grid.words.assign(std::size_t{1} << (3 * grid.bits), kUnset);
    Filler{nodes, grid}.fill(0, grid.bits, 0, 0, 0);

    std::vector<char> filled(grid.words.size());
    for (std::size_t c = 0; c < filled.size(); ++c) filled[c] = grid.words[c] != kUnset;
    std::array<std::future<std::vector<std::uint8_t>>, 8> work;
    for (std::uint32_t octant = 0; octant < 8; ++octant)
        work[octant] = std::async(std::launch::async, [&, octant] { return skipsTowards(filled, grid.bits, octant); });
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
