// SPDX-License-Identifier: Apache-2.0
// COPC: LAZ files whose chunks are the nodes of an octree, each with points that those above it lack.
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

/// Which nodes: the root has level 0.
using CopcChoice = std::function<bool(int level, const CopcBox& box)>;

bool isCopc(const LasFile& file);

/// The chunks of the nodes that are wanted, in the order of the file. Throws Error (kBadInput, without the file's name)
/// where the hierarchy leads out of the file, in circles, or to points that overlap.
std::vector<LazChunk> copcChunks(const LasFile& file, const CopcChoice& wanted);

} // namespace pointrt
