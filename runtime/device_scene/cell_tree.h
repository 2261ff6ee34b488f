// SPDX-License-Identifier: Apache-2.0
// The filled cells of a scan as boxes for ray queries (shaders/trace/query_cells.glsl).
#pragma once

#include <cstdint>
#include <vector>

#include "pointrt/pro.h"
#include "runtime/gpu/box_tree.h"
#include "runtime/gpu/program.h"
#include "shaders/shared/vectors.h"

namespace pointrt {

/// Plain data: free it with destroyCellTree, once.
struct CellTree {
    BoxTree boxes;
    Buffer cells; ///< the centre and the edge of each, in grid units
};

/// The centre and the edge of each cell of an index, in grid units; edge 0 for a cell that the grid does not refer to.
/// Skips out-of-range indices and cyclic groups of damaged files.
std::vector<gpu::vec4> cellsOf(const pro_index& index);

/// Whether the device can hold the tree of a scan with this many cells.
bool fitsCellTree(const Device& device, std::uint32_t cells);

/// Builds the tree of an index in host memory. Throws Error kCannotRun if out of memory.
CellTree createCellTree(Device& device, const pro_index& index);
void destroyCellTree(Device& device, CellTree& tree);
/// Bytes on the device.
std::uint64_t bytesOf(const CellTree& tree);

/// Bindings for descriptor set SET_PAGES.
std::vector<BufferBinding> treeBindings(const CellTree& tree);

} // namespace pointrt
