// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/cell_tree.h"

#include <cmath>
#include <span>

#include "pointrt/pro_index_layout.h"
#include "pointrt/pro_layout.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

/// A cell in units of its edge.
struct Place {
    std::uint32_t x = 0, y = 0, z = 0;
    float edge = 1; ///< in grid units
};

/// Part k of a place that is divided into side parts in each direction, x fastest.
Place partOf(const Place& place, std::uint32_t k, std::uint32_t side) {
    return {side * place.x + k % side, side * place.y + k / side % side, side * place.z + k / (side * side),
            place.edge / static_cast<float>(side)};
}

bool isFilled(std::uint32_t word) { return (word & PRO_SKIP_MASK) == 0; }

class CellLister {
public:
    explicit CellLister(const pro_index& index)
        : index_(index), cells_(index.cell_count), groups_left_(index.group_count) {}

    std::vector<gpu::vec4> list() {
        std::size_t word = 0;
        for (std::uint32_t z = 0; z < index_.size[2]; ++z)
            for (std::uint32_t y = 0; y < index_.size[1]; ++y)
                for (std::uint32_t x = 0; x < index_.size[0]; ++x) addBrick(index_.grid[word++], {x, y, z});
        return std::move(cells_);
    }

private:
    void addBrick(std::uint32_t word, const Place& place) {
        const std::uint32_t brick = word >> PRO_GRID_BRICK_SHIFT;
        if (!isFilled(word) || brick >= index_.brick_count) return;
        const std::uint32_t* words = index_.bricks + std::size_t{brick} * PRO_BRICK_WORDS;
        for (std::uint32_t k = 0; k < PRO_BRICK_WORDS; ++k) addCell(words[k], partOf(place, k, PRO_BRICK_SIDE));
    }

    void addCell(std::uint32_t word, const Place& place) {
        if (!isFilled(word)) return;
        if (word & PRO_CELL_INNER) return addGroup(word, place);
        const std::uint32_t cell = word >> PRO_CELL_INDEX_SHIFT;
        const auto middle = [&](std::uint32_t base) { return (static_cast<float>(base) + 0.5f) * place.edge; };
        if (cell < cells_.size()) cells_[cell] = {middle(place.x), middle(place.y), middle(place.z), place.edge};
    }

    /// Words number groups after the bricks.
    void addGroup(std::uint32_t word, const Place& place) {
        const std::size_t first = std::size_t{word >> PRO_CELL_INDEX_SHIFT} * PRO_GROUP_WORDS;
        const std::size_t bricks = std::size_t{index_.brick_count} * PRO_BRICK_WORDS;
        const bool exists = first >= bricks && (first - bricks) / PRO_GROUP_WORDS < index_.group_count;
        if (!exists || groups_left_ == 0) return;
        --groups_left_; // each group is referred to only once
        for (std::uint32_t k = 0; k < PRO_GROUP_WORDS; ++k) addCell(index_.bricks[first + k], partOf(place, k, 2));
    }

    const pro_index& index_;
    std::vector<gpu::vec4> cells_;
    std::uint32_t groups_left_;
};

/// How far the walk's look-ahead of one position step, and rounding, may take a ray out of a cell.
constexpr float kMarginSteps = 1.5f;

std::vector<VkAabbPositionsKHR> boxesOf(const std::vector<gpu::vec4>& cells, float margin) {
    std::vector<VkAabbPositionsKHR> boxes;
    boxes.reserve(cells.size());
    for (const gpu::vec4& cell : cells) {
        const float reach = 0.5f * cell.w + margin;
        boxes.push_back(
            {cell.x - reach, cell.y - reach, cell.z - reach, cell.x + reach, cell.y + reach, cell.z + reach});
    }
    return boxes;
}

} // namespace

std::vector<gpu::vec4> cellsOf(const pro_index& index) { return CellLister(index).list(); }

bool fitsCellTree(const Device& device, std::uint32_t cells) {
    return cells > 0 && cells <= kTreeBoxesMax && cells * sizeof(gpu::vec4) <= device.limits.maxStorageBufferRange;
}

CellTree createCellTree(Device& device, const pro_index& index) {
    const std::vector<gpu::vec4> cells = cellsOf(index);
    const float grid_cells = std::ldexp(1.0f, static_cast<int>(PRO_POSITION_BITS - index.shift)); // along the cube
    CellTree tree;
    const OnError undo([&] { destroyCellTree(device, tree); });
    tree.cells = createFilledBuffer(device, "cell box buffer", cells.data(), cells.size() * sizeof cells[0],
                                    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    tree.boxes = createBoxTree(device, boxesOf(cells, kMarginSteps * grid_cells * PRO_POSITION_STEP));
    return tree;
}

void destroyCellTree(Device& device, CellTree& tree) {
    destroyBoxTree(device, tree.boxes);
    destroyBuffer(device, tree.cells);
}

std::uint64_t bytesOf(const CellTree& tree) {
    return tree.boxes.bottom.bytes + tree.boxes.top.bytes + tree.cells.bytes;
}

std::vector<BufferBinding> treeBindings(const CellTree& tree) {
    return {{BINDING_CELL_TREE, &tree.boxes.top}, {BINDING_CELL_BOXES, &tree.cells}};
}

} // namespace pointrt
