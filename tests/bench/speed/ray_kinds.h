// SPDX-License-Identifier: Apache-2.0
// The kinds of rays that pictures consist of, to time tracers with.
#pragma once

#include <span>
#include <vector>

#include "tests/support/ray_caster.h"

namespace pointrt::test {

enum class RayKind { kPrimary, kShadow, kMirror, kDiffuse };
constexpr RayKind kRayKinds[] = {RayKind::kPrimary, RayKind::kShadow, RayKind::kMirror, RayKind::kDiffuse};
const char* nameOf(RayKind kind);

/// Secondary rays start this many local radii above the blended surface: up to that height the product ignores discs
/// that face the same way as self-intersections (kSelfHeight in shaders/trace/offset.glsl). Embree has no such rule, so
/// here the origin is moved and self_t is 0.
constexpr double kLiftRadii = 3;

/// Rays of this kind from the hits of primary rays, in their order. hits: of the primary rays, by RayCaster::cast.
///  - kShadow: towards light where the surface faces it, of unlimited length, as nothing is behind a light outside the
///    scene;
///  - kMirror: reflected at the blended normal;
///  - kDiffuse: in a cosine-weighted direction around that normal, the same for the same seed.
/// kPrimary gives the primary rays themselves.
std::vector<Ray> raysOf(RayKind kind, std::span<const Ray> primary, std::span<const CastHit> hits, Vec3 light,
                        std::uint64_t seed = 1);

} // namespace pointrt::test
