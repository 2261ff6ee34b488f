// SPDX-License-Identifier: Apache-2.0
// Rays to compare tracers by: the same for the same seed, on any machine.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tests/support/cube_splats.h"

namespace pointrt::test {

/// In cube units. Generated coordinates are floats held in doubles: every tracer gets exactly the same ray.
struct Ray {
    Vec3 origin;
    Vec3 direction;        ///< unit length to float precision
    Vec3 own_normal;       ///< of the surface it left, 0 for none: see TraceRay in shaders/trace/trace.glsl
    double own_t = 0;      ///< hits nearer than this on discs facing like own_normal are ignored
    bool diffused = false; ///< what scattered it last gathers photons
};

/// Uniform isotropic lines through bounds: every direction, and every parallel line that meets the sphere, alike.
/// They start outside of it.
std::vector<Ray> randomRays(const Sphere& bounds, std::size_t count, std::uint64_t seed);

/// Lines through a uniform point of a random disc, at a uniform elevation of 0 to 10 degrees to its plane, towards
/// either side. They start outside the sphere around all splats, which must not be empty.
std::vector<Ray> grazingRays(std::span<const CubeSplat> splats, std::size_t count, std::uint64_t seed);

} // namespace pointrt::test
