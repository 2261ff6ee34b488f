// SPDX-License-Identifier: Apache-2.0
// Points of a simulated scanner as columns of a file.
#pragma once

#include <string>
#include <vector>

#include "format/pointio/point_columns.h"
#include "pointrt/lidar.hpp"

namespace pointrt {

/// The columns of each point besides its position: all of LidarPoints, then attributes of the scene.
class LidarColumns {
public:
    /// @param for_las write scan angles in the steps of LAS 1.4
    /// @param attributes names; throws Error kBadUsage for unknown and duplicate ones
    LidarColumns(const TraceScene& scene, const LidarSensor& sensor, bool for_las,
                 const std::vector<std::string>& attributes);

    const std::vector<PointColumn>& columns() const { return columns_; }
    /// Overwrites block with the points.
    void fill(const LidarPoints& points, PointBlock& block) const;

private:
    void add(const std::string& attribute);

    const TraceScene& scene_;
    std::vector<PointColumn> columns_; ///< attributes last
    std::size_t attributes_ = 0;
};

} // namespace pointrt
