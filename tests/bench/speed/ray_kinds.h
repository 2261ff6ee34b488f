// SPDX-License-Identifier: Apache-2.0
// The rays that a picture is made of, to time tracers by.
#pragma once

#include <span>
#include <vector>

#include "tests/support/ray_caster.h"

namespace pointrt::test {

enum class RayKind { kPrimary, kShadow, kMirror, kDiffuse };
constexpr RayKind kRayKinds[] = {RayKind::kPrimary, RayKind::kShadow, RayKind::kMirror, RayKind::kDiffuse};
const char* nameOf(RayKind kind);

/// Secondary rays start this many local radii above the blended surface: the height up to which the product takes discs
/// of the same facing for the surface itself (kSelfHeight in shaders/trace/offset.glsl). Here the origin says so, with
/// self_t of 0, because Embree knows no own surface.
constexpr double kLiftRadii = 3;

/// What kPrimary rays go on as where they hit, in their order; hits are the primary rays' own, as by RayCaster::cast.
///  - kShadow: towards light where the surface faces it, and beyond: a light outside the scene has nothing behind it;
///  - kMirror: reflected at the blended normal;
///  - kDiffuse: in a direction distributed as the cosine to that normal, the same for the same seed.
/// kPrimary gives the primary rays themselves.
std::vector<Ray> raysOf(RayKind kind, std::span<const Ray> primary, std::span<const CastHit> hits, Vec3 light,
                        std::uint64_t seed = 1);

} // namespace pointrt::test
