// SPDX-License-Identifier: Apache-2.0
// Any rays through the product's own shaders: shaders/trace.comp.glsl as it stands, then shaders/blend.glsl.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "runtime/device.h"
#include "tests/support/rays.h"

namespace pointrt::test {

constexpr std::uint32_t kNoSplat = 0xFFFFFFFFu;

/// Distances are in cube units along the ray; nothing but splat is set where nothing is hit.
struct CastHit {
    double t_flat = 0; ///< to the first disc
    std::uint32_t splat = kNoSplat;
    double t_blended = 0; ///< to the blended surface there
    Vec3 normal;          ///< of the blended surface, unit length, towards the ray's origin
    float radius = 0;     ///< weighted mean of the splats' radii around, cube units
    bool hit() const { return splat != kNoSplat; }
};

/// A scene on a device, ready for rays.
class RayCaster {
public:
    /// Opens the .pro at path on the device that request selects. Throws Error kBadInput or kCannotRun.
    explicit RayCaster(const std::string& path, const DeviceRequest& request = {});
    ~RayCaster();
    RayCaster(const RayCaster&) = delete;
    RayCaster& operator=(const RayCaster&) = delete;

    /// A hit for each ray, in their order. Any number of rays: they go to the device in chunks.
    std::vector<CastHit> cast(std::span<const Ray> rays);

    /// Seconds that the trace dispatches alone have taken so far, submission and waiting included.
    double traceSeconds() const;
    const std::string& deviceName() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace pointrt::test
