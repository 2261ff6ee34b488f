// SPDX-License-Identifier: Apache-2.0
// Where secondary rays start.
#ifndef POINTRT_SHADERS_OFFSET_GLSL
#define POINTRT_SHADERS_OFFSET_GLSL
#include "shaders/lib/features.glsl"

// Neighbouring discs stand off the blended surface by curvature, by noise, and where several scans overlap by what
// their registration left: two or three radii on dense merges. So the ray starts a little up, where rounding cannot
// put it below, and hits on discs of the same facing are its own surface's until it is kOwnHeight radii up. At grazing
// angles it never would be: kOwnReach radii end it, four discs' width, beyond which the same surface may be met again.
const float kOwnHeight = 3.0;
const float kOwnReach = 8.0;
// Radii the origin is lifted by.
const float kLift = 0.25;
// Shapes are exact but for rounding: 4 units in the last place of the largest coordinate.
const float kShapeUlps = 4.0 / 8388608.0;

// Where the scan says how far its surface scatters, the ray is out of it kNoisyHeight standard deviations up: of the
// ten discs or so that it passes on the way, one in 10^5 stands that high above a point that itself is off by half of one
// (10 * Q(5 / sqrt(1.25)) = 4e-5). Down to 10 degrees of elevation it gets there; what lies lower is lit by less than
// a sixth.
const float kNoisyHeight = 5.0;
const float kNoisyReach = kNoisyHeight / 0.1736482; // sine of 10 degrees
// Noise counts up to this many radii: what stands more than 5 radii off casts its shadow all the same.
const float kNoiseMost = 1.0;
// SURFACE_REACH_MASK of these lead from kOwnReach to the most there is: kNoisyReach / kNoisyHeight * kOwnHeight = 17.28.
const float kReachStep = 0.3;

float roundingAt(vec3 position) {
    return kShapeUlps * max(abs(position.x), max(abs(position.y), abs(position.z)));
}

// Nearer hits are on the shape that the ray left: twice as far as its start was lifted, at 60 degrees from the normal.
float ownShapeReach(vec3 origin) { return 4.0 * roundingAt(origin); }

// The radius that stands for a noisy surface where rays leave it: kOwnHeight of it are as high as they have to go. reach:
// how many of it own hits reach, in the bits of a SurfaceInteraction.
float ownRadius(float radius, float noise, out uint reach) {
    noise = min(noise, kNoiseMost * radius);
    float own_radius = max(radius, kNoisyHeight / kOwnHeight * noise);
    float own_reach = max(kOwnReach * radius, kNoisyReach * noise) / own_radius;
    reach = uint((own_reach - kOwnReach) / kReachStep + 0.5) << SURFACE_REACH_SHIFT;
    return own_radius;
}

// Radii that own hits reach, of a surface with these bits.
float ownReach(uint bits) {
    if (!kHasNoise) return kOwnReach;
    return kOwnReach + kReachStep * float(bits >> SURFACE_REACH_SHIFT & SURFACE_REACH_MASK);
}

// Where a ray starts that leaves a surface on the side that normal points to; own_t: up to where hits are its own.
vec3 leaveSurface(vec3 position, vec3 normal, float radius, uint bits, vec3 direction, out float own_t) {
    own_t = radius * min(kOwnHeight / max(dot(normal, direction), 1e-6), ownReach(bits));
    return position + normal * (radius > 0.0 ? kLift * radius : roundingAt(position));
}

#endif
