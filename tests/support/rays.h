// SPDX-License-Identifier: Apache-2.0
// Random rays to compare tracers: deterministic for a seed, on any machine.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tests/support/cube_splats.h"

namespace pointrt::test {

/// In cube units. Generated coordinates are floats stored as doubles, so that every tracer gets exactly the same ray.
struct Ray {
    Vec3 origin;
    Vec3 direction;        ///< unit length to float precision
    Vec3 self_normal;      ///< normal of the surface it left, 0 for none: see TraceRay in shaders/trace/trace.glsl
    double self_t = 0;     ///< self-intersection distance on discs facing like self_normal
    bool diffused = false; ///< sets PATH_DIFFUSED
};

/// Uniform isotropic lines through the bounding sphere: directions, and parallel lines that hit the sphere, are
/// uniform. They start outside.
std::vector<Ray> randomRays(const Sphere& bounds, std::size_t count, std::uint64_t seed);

/// Lines through a uniform point of a random disc, at a uniform elevation of 0 to 10 degrees to its plane, towards
/// either side. They start outside the sphere around all splats, which must not be empty.
std::vector<Ray> grazingRays(std::span<const CubeSplat> splats, std::size_t count, std::uint64_t seed);

} // namespace pointrt::test
