// SPDX-License-Identifier: Apache-2.0
// A tiny handmade tracing index: it satisfies every rule of the format, but does not belong to any splats.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pointrt/pro_index_layout.h"
#include "tiny_scene.h"

namespace pointrt::test {

struct Index {
    pro_index frame{};
    std::vector<std::uint32_t> grid, bricks, cells, slabs, near_splats, listed, blending;

    /// Sets the counts in frame and returns it with pointers into this index.
    pro_index view() {
        const auto count = [](const auto& words, std::uint32_t each) {
            return static_cast<std::uint32_t>(words.size()) / each;
        };
        frame.group_count = count(bricks, PRO_GROUP_WORDS) - frame.brick_count * (PRO_BRICK_WORDS / PRO_GROUP_WORDS);
        frame.cell_count = count(slabs, 1);
        frame.near_count = count(near_splats, PRO_NEAR_WORDS);
        frame.blending_count = 2 * count(blending, 1);
        frame.grid = grid.data();
        frame.bricks = bricks.data();
        frame.cells = cells.data();
        frame.slabs = slabs.data();
        frame.near_splats = near_splats.data();
        frame.listed = listed.data();
        frame.blending = blending.data();
        return frame;
    }

    /// Adds a cell with count near splats from first on; blending_count splats from the start of the row only blend in
    /// it.
    void addCell(std::uint32_t first, std::uint32_t count, std::uint32_t blending_count) {
        constexpr std::uint32_t kHalfOne = 0x3C00, kOffset = 3u << PRO_CELL_OFFSET_SHIFT;
        cells.insert(cells.end(), {first, count | kHalfOne << PRO_CELL_CODES_SHIFT,
                                   2 * static_cast<std::uint32_t>(blending.size()), blending_count | kOffset});
        slabs.push_back(0x12345678);
        const auto number = [&](std::uint32_t k) { return (k - first) & 0xFFFFu; };
        for (std::uint32_t k = 0; k < blending_count; k += 2)
            blending.push_back(number(k) | (k + 1 < blending_count ? number(k + 1) << 16 : 0u));
    }

    /// Adds a row of these splats.
    void finish(std::vector<std::uint32_t> row) {
        listed = std::move(row);
        near_splats.assign(listed.size() * PRO_NEAR_WORDS, 0x01020304);
        if (blending.empty()) blending.push_back(0);
    }

    void write(Scene& scene, const std::string& path) {
        const pro_view sections = scene.view();
        const pro_index pointers = view();
        writePro(path, scene.info, sections, &pointers);
    }
};

constexpr std::uint32_t kNothingNear = 0x11111111; ///< an empty word with skips of one cell

inline std::uint32_t cellWord(std::uint32_t cell) { return cell << PRO_CELL_INDEX_SHIFT; }
inline std::uint32_t groupWord(std::uint32_t group) { return group << PRO_CELL_INDEX_SHIFT | PRO_CELL_INNER; }

/// A grid of two cells, the second with brick 0. Words 0, 1 and 2 of the brick are cell 0, group 9 and cell 3; words 0
/// and 1 of group 9 are cell 1 and group 8; word 0 of group 8 is cell 2.
inline Index tinyIndex() {
    Index index;
    index.frame.shift = PRO_POSITION_BITS - 1;
    index.frame.size[0] = 2;
    index.frame.size[1] = index.frame.size[2] = 1;
    index.frame.uneven = 1;
    index.frame.brick_count = 1;
    index.grid = {kNothingNear, 0u << PRO_GRID_BRICK_SHIFT};
    index.bricks.assign(PRO_BRICK_WORDS + 2 * PRO_GROUP_WORDS, kNothingNear);
    index.bricks[0] = cellWord(0);
    index.bricks[1] = groupWord(9);
    index.bricks[2] = cellWord(3);
    index.bricks[9 * PRO_GROUP_WORDS] = cellWord(1);
    index.bricks[9 * PRO_GROUP_WORDS + 1] = groupWord(8);
    index.bricks[8 * PRO_GROUP_WORDS] = cellWord(2);
    index.addCell(0, 1, 0);
    index.addCell(1, 2, 1);
    index.addCell(2, 3, 2);
    index.addCell(4, 1, 0);
    index.finish({0, 1, 2, 3, 4, 0});
    return index;
}

/// An index with one brick cell, halved this many times.
inline Index deepIndex(std::uint32_t halvings) {
    Index index = tinyIndex();
    const std::uint32_t first = PRO_BRICK_WORDS / PRO_GROUP_WORDS;
    index.bricks.assign(PRO_BRICK_WORDS + halvings * PRO_GROUP_WORDS, kNothingNear);
    for (std::uint32_t k = 1; k < halvings; ++k) index.bricks[(first + k) * PRO_GROUP_WORDS] = groupWord(first + k - 1);
    index.bricks[first * PRO_GROUP_WORDS] = cellWord(0);
    index.bricks[5] = groupWord(first + halvings - 1);
    for (auto* words : {&index.cells, &index.slabs, &index.blending}) words->clear();
    index.addCell(0, 2, 0);
    index.finish({0, 1});
    return index;
}

} // namespace pointrt::test
