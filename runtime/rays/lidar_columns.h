// SPDX-License-Identifier: Apache-2.0
// Points of a simulated scanner as columns of a file.
#pragma once

#include <string>
#include <vector>

#include "format/pointio/point_columns.h"
#include "pointrt/lidar.hpp"

namespace pointrt {

/// What of each point is told besides its position: all of LidarPoints, then attributes of the scene.
class LidarColumns {
public:
    /// @param for_las scan angles are told in LAS 1.4's steps
    /// @param attributes names. Throws Error kBadUsage where the scene has none of a name, or it is there already
    LidarColumns(const TraceScene& scene, const LidarSensor& sensor, bool for_las,
                 const std::vector<std::string>& attributes);

    const std::vector<PointColumn>& columns() const { return columns_; }
    /// The points, in place of what block holds.
    void fill(const LidarPoints& points, PointBlock& block) const;

private:
    void add(const std::string& attribute);

    const TraceScene& scene_;
    std::vector<PointColumn> columns_; ///< attributes last
    std::size_t attributes_ = 0;
};

} // namespace pointrt
