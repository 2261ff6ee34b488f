// SPDX-License-Identifier: Apache-2.0
// Where secondary rays start.

// Neighbouring discs stand off the blended surface by noise and curvature, but within their slab (or they would not
// blend). So the ray starts half a slab up, where rounding cannot put it below, and hits on discs of the same facing are
// its own surface's until it has left the slab. At grazing angles it never would: 3 radii end it, a disc's width and
// a half, beyond which the same surface may rightly be met again.
const float kOwnSurfaceRadii = 3.0;
// For surfaces without splats (the room's walls): a few units in the last place of a coordinate near 4.
const float kWallOffset = 2e-6;

vec3 leaveSurface(vec3 position, vec3 normal, float radius, vec3 direction, out float own_t) {
    float slab = params.splat.z * radius;
    own_t = radius > 0.0 ? min(slab / max(dot(normal, direction), 1e-6), kOwnSurfaceRadii * radius) : 0.0;
    return position + normal * (radius > 0.0 ? 0.5 * slab : kWallOffset);
}
