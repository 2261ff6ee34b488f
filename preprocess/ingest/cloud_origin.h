// SPDX-License-Identifier: GPL-3.0-or-later
// The origin of a cloud, chosen from its first positions.
#pragma once

#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// A position with coordinates that are whole numbers.
Vec3d wholeNumbers(const Vec3d& position);

/// Chooses Cloud::origin, relative to which positions are rounded to float. It is the first position, unless that lies
/// a thousand times as far from the others as they lie from each other: 0 0 0 ahead of a scan in a national grid would
/// round the whole scan to half a metre.
class OriginChooser {
public:
    /// To be called for each position that the cloud has just received, in double precision.
    void add(Cloud& cloud, const Vec3d& position);

    /// Chooses the origin from the positions received so far, unless it is already chosen.
    void finish(Cloud& cloud);

private:
    std::vector<Vec3d> first_positions_;
    bool is_chosen_ = false;
};

} // namespace pointrt
