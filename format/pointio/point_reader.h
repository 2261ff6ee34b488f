// SPDX-License-Identifier: Apache-2.0
// Points of LAS, LAZ and PLY files with all that the files say of them, block by block.
#pragma once

#include <memory>
#include <string>

#include "format/pointio/point_columns.h"

namespace pointrt {

class PointReader {
public:
    virtual ~PointReader() = default;
    /// count is that of the file. Of LAS files metadata has what a LAS writer takes from it; else it is empty, and
    /// position_step 0.
    virtual const PointOutline& outline() const = 0;
    /// The next points in place of those in block, up to most of them; false where there are none any more. Throws
    /// Error kBadInput "FILE[:PLACE]: reason".
    virtual bool next(PointBlock& block, std::size_t most) = 0;
};

/// Null for what begins as none of these. Throws Error: kBadInput "FILE[:LINE]: reason" for a file that cannot be read
/// or is broken; kCannotRun for LAZ in a build without it.
std::unique_ptr<PointReader> openPointReader(const std::string& path);

} // namespace pointrt
