// SPDX-License-Identifier: Apache-2.0
// Acceleration structures of boxes, for ray queries.
#pragma once

#include <span>

#include "runtime/gpu/device.h"
#include "runtime/gpu/resources.h"

namespace pointrt {

/// Largest number of boxes in a tree: the minimum that every device with ray queries must support.
constexpr std::size_t kTreeBoxesMax = (1u << 24) - 1;

/// A bottom level with the boxes, and a top level whose only instance is the bottom level. Programs bind the top level;
/// each program traces one instance of the scene, in the coordinates of its boxes. Plain data: free it with
/// destroyBoxTree, once.
struct BoxTree {
    Buffer bottom, top;
};

/// Builds a tree of 1 to kTreeBoxesMax boxes; a candidate's primitive index is its box's index in the list. The device
/// must support ray queries. Throws Error kCannotRun if out of memory.
BoxTree createBoxTree(Device& device, std::span<const VkAabbPositionsKHR> boxes);
void destroyBoxTree(Device& device, BoxTree& tree);

} // namespace pointrt
