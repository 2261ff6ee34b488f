// SPDX-License-Identifier: GPL-3.0-or-later
// Points of a LAS file in blocks, unpacked on all cores and delivered in the order of the file.
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
    std::vector<std::vector<char>> values; ///< [fields], in the fields' order
    std::uint64_t done_bytes = 0;          ///< number of leading bytes of the file that are no longer needed
};

/// What to read from a file.
struct LasPlan {
    const LasFile& file;
    const std::vector<LasField>& fields;
    LazLayout layout;             ///< of compressed points
    std::vector<LazChunk> chunks; ///< to read; a single one for uncompressed points
};

/// Calls use for blocks of at most about 64 Ki points, or for each chunk of a LAZ file of up to 8 MiB. Takes less than
/// 64 MiB whatever the file contains. Throws Error (kBadInput, without the file's name) for the first invalid
/// compressed points in the file, and whatever use throws.
void forLasBlocks(const LasPlan& plan, const std::function<void(const LasBlock&)>& use);

/// Decodes records.
void decodeRecords(const LasPlan& plan, const std::vector<char>& records, LasBlock& block);

} // namespace pointrt
