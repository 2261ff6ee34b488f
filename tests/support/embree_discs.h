// SPDX-License-Identifier: Apache-2.0
// Splats of a .pro as oriented discs and spheres in Embree: closest hits by an independent program with its own
// hierarchy.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "tests/support/rays.h"

struct RTCSceneTy; // Embree's rtcore_scene.h

namespace pointrt::test {

struct EmbreeHit {
    double t = 0;                      ///< cube units along the ray
    std::uint32_t splat = 0xFFFFFFFFu; ///< kNoSplat (ray_caster.h) for a miss; t is 0 then
};

/// Scene flag of Embree: kRobust never misses a hit by rounding in the hierarchy; kFast is the default.
enum class EmbreeFlag { kRobust, kFast };

/// A built scene. Embree computes in float, on the same ray floats as the shaders.
class EmbreeDiscs {
public:
    /// splats must not be empty. Throws Error kCannotRun if Embree fails.
    explicit EmbreeDiscs(std::span<const CubeSplat> splats, EmbreeFlag flag = EmbreeFlag::kRobust);
    ~EmbreeDiscs();
    EmbreeDiscs(const EmbreeDiscs&) = delete;
    EmbreeDiscs& operator=(const EmbreeDiscs&) = delete;

    /// Closest hits with t > 0, in the order of rays, on all cores. Ignores self_normal and self_t.
    std::vector<EmbreeHit> cast(std::span<const Ray> rays) const;
    /// The same, 8 rays at a time by rtcIntersect8: neighbours in rays share a packet.
    std::vector<EmbreeHit> castPackets(std::span<const Ray> rays) const;

    /// The RTCScene, valid during the lifetime of this object.
    RTCSceneTy* scene() const;
    /// Bytes that Embree allocated for the scene, splats and hierarchy, by its memory monitor.
    std::int64_t bytes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace pointrt::test
