// SPDX-License-Identifier: GPL-3.0-or-later
// Records of buckets: values as in memory, packed without gaps.
//   position  float x 3, relative to the corner of the tile's core
//   normal    float x 3, if the schema has normals
//   colour    byte x 3, if it has colours
//   radius    float, if it has radii
//   noise     float, if a depth camera's depths were quantised
//   silhouette  byte, 1 at the silhouettes of range grids, if there are grids
//   scan      1, 2 or 4 bytes, if there are several
//   attributes, each in its type
// A trailer follows the last record. Records are in the order of the input.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Offsets in bytes from the start of a record.
struct BucketLayout {
    std::size_t normal = 0, color = 0, radius = 0, noise = 0, silhouette = 0, scan = 0;
    std::vector<std::size_t> attributes; ///< of the schema's attributes, except the scan number
    std::size_t record_bytes = 0;

    explicit BucketLayout(const PlanSchema& schema);
};

struct BucketTrailer {
    static constexpr std::uint64_t kMagic = 0x4B43425452544E50u; ///< "PNTRTBCK" as bytes
    std::uint64_t magic = kMagic;
    std::uint64_t record_bytes = 0, records = 0;
    std::uint64_t xxh3 = 0; ///< of all records
};

} // namespace pointrt
