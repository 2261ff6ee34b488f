// SPDX-License-Identifier: GPL-3.0-or-later
// Points of a LAS file in blocks: unpacked on all cores, handed on in the order of the file.
#pragma once

#include <functional>
#include <vector>

#include "format/pointio/las_fields.h"
#include "format/pointio/laz.h"
#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// Points in arrays.
struct LasBlock {
    std::vector<Vec3d> positions;
    std::vector<std::vector<char>> values; ///< of each field, in the fields' order
    std::uint64_t done_bytes = 0;          ///< of the file, so many are not needed any more
};

/// What is to be read of a file.
struct LasPlan {
    const LasFile& file;
    const std::vector<LasField>& fields;
    LazLayout layout;             ///< of packed points
    std::vector<LazChunk> chunks; ///< that are wanted; of points that are not packed one, which has all of them
};

/// Calls use for blocks of at most some 64 Ki points, or a chunk of a LAZ file where that has up to 8 MiB. Takes less
/// than 64 MiB whatever the file says. Throws Error (kBadInput, without the file's name) where packed points are
/// broken, the first ones in the file, and what use throws.
void forLasBlocks(const LasPlan& plan, const std::function<void(const LasBlock&)>& use);

} // namespace pointrt
