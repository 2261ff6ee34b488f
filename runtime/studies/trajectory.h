// SPDX-License-Identifier: Apache-2.0
// Where a scanner is at any time between its poses.
#pragma once

#include <vector>

#include "pointrt/lidar.hpp"
#include "runtime/util/vec.h"

namespace pointrt {

/// A scanner's place and how it is turned.
struct LidarStand {
    Vec3 position;
    std::array<double, 4> rotation{0, 0, 0, 1}; ///< unit quaternion x y z w

    Vec3 turned(Vec3 direction) const;
};

class LidarPath {
public:
    /// @param poses not empty, times increasing, quaternions that are not 0
    explicit LidarPath(std::vector<LidarPose> poses);

    /// Before the first pose and behind the last one it stands still.
    LidarStand at(double time) const;

private:
    std::vector<LidarPose> poses_; ///< unit quaternions
};

} // namespace pointrt
