// SPDX-License-Identifier: Apache-2.0
// A tiny tracing index, by hand: not of any splats, but every rule of the format is met.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pointrt/pro_index_layout.h"
#include "tiny_scene.h"

namespace pointrt::test {

struct Index {
    pro_index frame{};
    std::vector<std::uint32_t> grid, bricks, cells, slabs, near_splats, lists, blend_ranges;

    /// Sets the counts in frame and returns it with pointers into this index.
    pro_index view() {
        const auto count = [](const auto& words, std::uint32_t each) {
            return static_cast<std::uint32_t>(words.size()) / each;
        };
        frame.group_count = count(bricks, PRO_GROUP_WORDS) - frame.brick_count * (PRO_BRICK_WORDS / PRO_GROUP_WORDS);
        frame.cell_count = count(slabs, 1);
        frame.near_count = count(near_splats, PRO_NEAR_WORDS);
        frame.list_count = count(lists, 1);
        frame.grid = grid.data();
        frame.bricks = bricks.data();
        frame.cells = cells.data();
        frame.slabs = slabs.data();
        frame.near_splats = near_splats.data();
        frame.lists = lists.data();
        frame.blend_ranges = blend_ranges.data();
        return frame;
    }

    /// A cell of count near splats; blending of them are listed besides, by finish().
    void addCell(std::uint32_t count, std::uint32_t blending) {
        constexpr std::uint32_t kHalfOne = 0x3C00;
        cells.insert(cells.end(), {static_cast<std::uint32_t>(near_splats.size()) / PRO_NEAR_WORDS,
                                   count | kHalfOne << PRO_CELL_CODES_SHIFT});
        slabs.push_back(0x12345678);
        near_splats.resize(near_splats.size() + (count + 1) / 2 * 2 * PRO_NEAR_WORDS, 0x01020304);
        blend_ranges.insert(blend_ranges.end(), {0, blending});
    }

    /// Lists splat 0 throughout and lets the blend ranges follow one another.
    void finish() {
        std::uint32_t next = static_cast<std::uint32_t>(near_splats.size()) / PRO_NEAR_WORDS;
        for (std::size_t k = 0; k < blend_ranges.size(); k += PRO_BLEND_RANGE_WORDS) {
            blend_ranges[k] = next;
            next += blend_ranges[k + 1];
        }
        lists.assign((next + 3) / 4 * 4, 0);
    }

    void write(Scene& scene, const std::string& path) {
        const pro_view sections = scene.view();
        const pro_index pointers = view();
        writePro(path, scene.info, sections, &pointers);
    }
};

constexpr std::uint32_t kNothingNear = 0x11111111; ///< an empty word that skips one cell

inline std::uint32_t cellWord(std::uint32_t cell) { return cell << PRO_CELL_INDEX_SHIFT; }
inline std::uint32_t groupWord(std::uint32_t group) { return group << PRO_CELL_INDEX_SHIFT | PRO_CELL_INNER; }

/// A grid of two cells, the second of them brick 0. Its word 0 is cell 0, word 1 group 9, word 2 cell 3; in group 9
/// word 0 is cell 1 and word 1 group 8, where word 0 is cell 2.
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
    index.addCell(1, 1);
    index.addCell(2, 0);
    index.addCell(3, 2);
    index.addCell(1, 0);
    index.finish();
    index.lists = {0, 0, 1, 2, 2, 3, 4, 0, 4, 0, 1, 3, 4, 0, 0, 0};
    return index;
}

/// One brick cell halved this often.
inline Index deepIndex(std::uint32_t halvings) {
    Index index = tinyIndex();
    const std::uint32_t first = PRO_BRICK_WORDS / PRO_GROUP_WORDS;
    index.bricks.assign(PRO_BRICK_WORDS + halvings * PRO_GROUP_WORDS, kNothingNear);
    for (std::uint32_t k = 1; k < halvings; ++k) index.bricks[(first + k) * PRO_GROUP_WORDS] = groupWord(first + k - 1);
    index.bricks[first * PRO_GROUP_WORDS] = cellWord(0);
    index.bricks[5] = groupWord(first + halvings - 1);
    for (auto* words : {&index.cells, &index.slabs, &index.near_splats, &index.blend_ranges}) words->clear();
    index.addCell(2, 0);
    index.finish();
    return index;
}

} // namespace pointrt::test
