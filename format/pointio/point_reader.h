// SPDX-License-Identifier: Apache-2.0
// Reads points of LAS, LAZ and PLY files with all of their columns, block by block.
#pragma once

#include <memory>
#include <string>

#include "format/pointio/point_columns.h"

namespace pointrt {

class PointReader {
public:
    virtual ~PointReader() = default;
    /// LAS files set metadata for a LAS writer; others leave it empty, and position_step 0.
    virtual const PointOutline& outline() const = 0;
    /// Overwrites block with the next points, at most `most`. False at the end. Throws Error kBadInput
    /// "FILE[:PLACE]: reason".
    virtual bool next(PointBlock& block, std::size_t most) = 0;
};

/// Null if the first bytes are of another format. Throws Error: kBadInput "FILE[:LINE]: reason" if the file cannot be
/// read or is malformed; kCannotRun for LAZ in a build without it.
std::unique_ptr<PointReader> openPointReader(const std::string& path);

} // namespace pointrt
