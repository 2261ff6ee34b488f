// SPDX-License-Identifier: Apache-2.0
// Hits of a pulse's rays as the points that a scanner tells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pointrt/lidar.hpp"
#include "runtime/studies/aim.h"
#include "runtime/studies/returns.h"

namespace pointrt {

/// What one pulse's rays hit: as castRays tells it, and how much of the light comes back.
struct LidarHits {
    std::span<const double> t;
    std::span<const std::uint32_t> splat_ids, instance_ids;
    std::span<const std::uint32_t> tile_ids; ///< empty where the scene has no tile sets
    std::span<const float> normals;          ///< [rays][3]
    std::span<const float> reflectances;
};

/// A sensor's lengths in units of the scan, and what is random of a run. One for each thread.
class LidarMeter {
public:
    /// sensor holds what it should (check.h).
    LidarMeter(const LidarSensor& sensor, std::uint64_t seed, double metres_per_unit);

    /// Appends the pulse's returns to points.
    void measure(const LidarShot& shot, const LidarHits& hits, LidarPoints& points);

private:
    void gather(const LidarShot& shot, const LidarHits& hits);
    void keep();
    void append(const LidarShot& shot, std::size_t number, bool has_tiles, LidarPoints& points) const;

    const LidarSensor& sensor_;
    LidarRandom random_;
    double metres_per_unit_;
    double reference_range_;
    std::vector<LidarTouch> touches_;
    std::vector<LidarReturn> returns_;
};

} // namespace pointrt
