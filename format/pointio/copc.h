// SPDX-License-Identifier: Apache-2.0
// COPC: LAZ files whose chunks are the nodes of an octree; each adds points to those of its ancestors.
// After "COPC Specification 1.0", https://copc.io.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "format/pointio/laz.h"

namespace pointrt {

/// A box in the file's coordinates.
struct CopcBox {
    std::array<double, 3> low, high;
};

/// Selects nodes. The root has level 0.
using CopcChoice = std::function<bool(int level, const CopcBox& box)>;

bool isCopc(const LasFile& file);

/// The chunks of the selected nodes, in the order of the file. Throws Error (kBadInput, without the file's name) if the
/// hierarchy is cyclic, points outside the file, or has overlapping chunks.
std::vector<LazChunk> copcChunks(const LasFile& file, const CopcChoice& is_selected);

} // namespace pointrt
