// SPDX-License-Identifier: Apache-2.0
// The pose of a scanner at any time, interpolated between given poses.
#pragma once

#include <vector>

#include "pointrt/lidar.hpp"
#include "runtime/util/vec.h"

namespace pointrt {

struct ScannerPose {
    Vec3 position;
    std::array<double, 4> rotation{0, 0, 0, 1}; ///< unit quaternion x y z w

    /// From the scanner's frame to the scan's.
    Vec3 rotated(Vec3 direction) const;
};

class ScannerPath {
public:
    /// @param poses at least one, in order of time, with quaternions other than 0
    explicit ScannerPath(std::vector<LidarPose> poses);

    /// The first pose holds before its time, the last one after it.
    ScannerPose at(double time) const;

private:
    std::vector<LidarPose> poses_; ///< unit quaternions
};

} // namespace pointrt
