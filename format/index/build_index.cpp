// SPDX-License-Identifier: Apache-2.0
#include "format/index/build_index.h"

#include "format/index/cell_skips.h"

namespace pointrt {

TracingIndex buildTracingIndex(const pro_info& info, const pro_view& view, const IndexOptions& options) {
    TracingIndex index;
    index.grid = frameEntryGrid(info, view);
    index.bricks = buildBricks(info, view, index.grid, options);
    fillEntryGrid(index.grid, index.bricks.corners, options.threads);
    fillCellSkips(index.grid, index.bricks.corners.size(), index.bricks.words, options.threads);
    index.bricks.brick_count = static_cast<std::uint32_t>(index.bricks.corners.size());
    std::vector<Corner>().swap(index.bricks.corners);
    return index;
}

pro_index indexView(const TracingIndex& index) {
    const auto count = [](const Words& words, std::uint32_t each) {
        return static_cast<std::uint32_t>(words.size() / each);
    };
    const EntryGrid& grid = index.grid;
    const Bricks& bricks = index.bricks;
    pro_index plain{};
    plain.shift = grid.shift;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        plain.origin[axis] = grid.origin[axis];
        plain.size[axis] = grid.size[axis];
    }
    plain.uneven = grid.uneven ? 1 : 0;
    plain.brick_count = bricks.brick_count;
    plain.group_count = count(bricks.words, PRO_GROUP_WORDS) - bricks.brick_count * (PRO_BRICK_WORDS / PRO_GROUP_WORDS);
    plain.cell_count = count(bricks.cells, PRO_CELL_WORDS);
    plain.near_count = count(bricks.listed, 1);
    plain.blending_count = 2 * count(bricks.blending, 1);
    plain.grid = grid.words.data();
    plain.bricks = bricks.words.data();
    plain.cells = bricks.cells.data();
    plain.slabs = bricks.slabs.data();
    plain.near_splats = bricks.near.data();
    plain.listed = bricks.listed.data();
    plain.blending = bricks.blending.data();
    return plain;
}

} // namespace pointrt
