// SPDX-License-Identifier: Apache-2.0
// Embree's oriented discs over the splats of a .pro: first hits by another program, with another hierarchy.
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
    std::uint32_t splat = 0xFFFFFFFFu; ///< kNoSplat (ray_caster.h) where nothing is hit; t is 0 then
};

/// Embree's scene flag: kRobust never loses a hit to rounding in the hierarchy, kFast is what it does by default.
enum class EmbreeFlag { kRobust, kFast };

/// A built scene. Embree computes in float, on the same ray floats as the shaders.
class EmbreeDiscs {
public:
    /// splats must not be empty. Throws Error kCannotRun where Embree refuses.
    explicit EmbreeDiscs(std::span<const CubeSplat> splats, EmbreeFlag flag = EmbreeFlag::kRobust);
    ~EmbreeDiscs();
    EmbreeDiscs(const EmbreeDiscs&) = delete;
    EmbreeDiscs& operator=(const EmbreeDiscs&) = delete;

    /// A first hit with t > 0 for each ray, in their order, on all cores; own_normal and own_t play no part.
    std::vector<EmbreeHit> cast(std::span<const Ray> rays) const;
    /// The same, 8 rays at a time by rtcIntersect8: neighbours in rays share a packet.
    std::vector<EmbreeHit> castPackets(std::span<const Ray> rays) const;

    /// The RTCScene, which lives as long as this does.
    RTCSceneTy* scene() const;
    /// What Embree holds for the built scene, discs and hierarchy, by its memory monitor.
    std::int64_t bytes() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace pointrt::test
