// SPDX-License-Identifier: Apache-2.0
// How much of the light the scene's splats send back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pointrt/lidar.hpp"

namespace pointrt {

/// What was hit, as castRays tells it.
struct LidarHitIds {
    std::span<const std::uint32_t> splats, instances;
    std::span<const std::uint32_t> tiles; ///< empty where the scene has no tile sets
};

class LidarSurface {
public:
    /// Throws TraceError kBadUsage where the scene has not the attribute that reflectance names.
    LidarSurface(const TraceScene& scene, const LidarReflectance& reflectance);

    /// Reflectances of what was hit; those of misses mean nothing.
    void look(const LidarHitIds& hits, std::span<float> reflectances);

private:
    void lookAtColors(std::span<float> reflectances) const;
    void lookAtAttribute(std::span<float> reflectances) const;

    const TraceScene& scene_;
    LidarReflectance reflectance_; ///< source is never kScan
    SceneAttribute attribute_;
    std::vector<std::byte> room_;
};

} // namespace pointrt
