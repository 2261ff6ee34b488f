// SPDX-License-Identifier: Apache-2.0
// Reflectances of the splats that rays hit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pointrt/lidar.hpp"

namespace pointrt {

/// IDs of hits, as from castRays.
struct HitIds {
    std::span<const std::uint32_t> splats, instances;
    std::span<const std::uint32_t> tiles; ///< empty for scenes without tile sets
};

class ReflectanceLookup {
public:
    /// Throws TraceError kBadUsage if the scene lacks the attribute that reflectance names.
    ReflectanceLookup(const TraceScene& scene, const LidarReflectance& reflectance);

    /// Writes a reflectance for each hit; those of misses are undefined.
    void lookUp(const HitIds& hits, std::span<float> reflectances);

private:
    void fromColors(std::span<float> reflectances) const;
    void fromAttribute(std::span<float> reflectances) const;

    const TraceScene& scene_;
    LidarReflectance reflectance_; ///< source is never kScan
    SceneAttribute attribute_;
    std::vector<std::byte> buffer_;
};

} // namespace pointrt
