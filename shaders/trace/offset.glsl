// SPDX-License-Identifier: Apache-2.0
// Where secondary rays start.
#ifndef POINTRT_SHADERS_OFFSET_GLSL
#define POINTRT_SHADERS_OFFSET_GLSL

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

float roundingAt(vec3 position) {
    return kShapeUlps * max(abs(position.x), max(abs(position.y), abs(position.z)));
}

// Nearer hits are on the shape that the ray left: twice as far as its start was lifted, at 60 degrees from the normal.
float ownShapeReach(vec3 origin) { return 4.0 * roundingAt(origin); }

// Where a ray starts that leaves a surface on the side that normal points to; own_t: up to where hits are its own.
vec3 leaveSurface(vec3 position, vec3 normal, float radius, vec3 direction, out float own_t) {
    own_t = radius * min(kOwnHeight / max(dot(normal, direction), 1e-6), kOwnReach);
    return position + normal * (radius > 0.0 ? kLift * radius : roundingAt(position));
}

#endif
