// SPDX-License-Identifier: Apache-2.0
// Ray offsets against self-intersection: the origin of a ray that leaves a surface, and the distance along the ray
// within which hits on that surface are ignored.
#ifndef POINTRT_SHADERS_OFFSET_GLSL
#define POINTRT_SHADERS_OFFSET_GLSL
#include "shaders/lib/features.glsl"

// Neighbouring discs deviate from the blended surface by curvature, noise and, where several scans overlap, residual
// registration errors: by two or three radii on dense merges. So the ray origin is lifted only a little, just enough
// that rounding cannot put it below the surface. Hits on discs that face the same way are ignored as self-intersections
// until the ray is kSelfHeight radii above the surface, or, since grazing rays would never get so high, kSelfReach
// radii (four disc widths) from its origin.
const float kSelfHeight = 3.0;
const float kSelfReach = 8.0;
// The height in radii to which the origin is lifted.
const float kLift = 0.25;
// Bound of the rounding error on shapes, which are exact otherwise: 4 units in the last place of the largest
// coordinate.
const float kShapeUlps = 4.0 / 8388608.0;

// If the scan stores noise, a ray counts as clear of the surface at a height of kNoisyHeight standard deviations. On
// the way there, it passes about ten discs. The probability that one of them is that high above the ray's origin, which
// itself deviates by half a standard deviation, is 10 * Q(5 / sqrt(1.25)) = 4e-5. kNoisyReach is long enough for rays
// at elevations of 10 degrees and more; lower rays carry less than a sixth of the light.
const float kNoisyHeight = 5.0;
const float kNoisyReach = kNoisyHeight / 0.1736482; // sine of 10 degrees
// Upper limit of the noise, in radii, so that geometry more than 5 radii away always casts its shadow.
const float kNoiseMost = 1.0;
// The SURFACE_SELF_REACH_MASK steps from kSelfReach to the largest reach, kNoisyReach / kNoisyHeight * kSelfHeight =
// 17.28.
const float kReachStep = 0.3;

float roundingAt(vec3 position) {
    return kShapeUlps * max(abs(position.x), max(abs(position.y), abs(position.z)));
}

// Self-intersection distance on shapes: twice the lift of the origin, at 60 degrees from the normal.
float shapeSelfDistance(vec3 origin) { return 4.0 * roundingAt(origin); }

// The radius to offset rays by on a noisy surface: kSelfHeight times this is the height that rays must reach. reach:
// the bits of selfReach for a SurfaceInteraction.
float offsetRadius(float radius, float noise, out uint reach) {
    noise = min(noise, kNoiseMost * radius);
    float offset_radius = max(radius, kNoisyHeight / kSelfHeight * noise);
    float self_reach = max(kSelfReach * radius, kNoisyReach * noise) / offset_radius;
    reach = uint((self_reach - kSelfReach) / kReachStep + 0.5) << SURFACE_SELF_REACH_SHIFT;
    return offset_radius;
}

// Largest self-intersection distance, in radii, of a surface with these bits.
float selfReach(uint bits) {
    if (!kHasNoise) return kSelfReach;
    return kSelfReach + kReachStep * float(bits >> SURFACE_SELF_REACH_SHIFT & SURFACE_SELF_REACH_MASK);
}

// Origin of a ray that leaves a surface on the side that normal points to. self_t receives the self-intersection
// distance.
vec3 offsetRayOrigin(vec3 position, vec3 normal, float radius, uint bits, vec3 direction, out float self_t) {
    self_t = radius * min(kSelfHeight / max(dot(normal, direction), 1e-6), selfReach(bits));
    return position + normal * (radius > 0.0 ? kLift * radius : roundingAt(position));
}

#endif
