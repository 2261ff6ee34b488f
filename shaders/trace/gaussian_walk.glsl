// SPDX-License-Identifier: Apache-2.0
// The walk through the octree of Gaussians, front to back and without a stack: from node to sibling, up to the parent
// and down to the first child. Cells have integer coordinates, and the distance to a plane is computed in the same way
// for every cell that the plane bounds. So the intervals of adjacent cells along a ray join without gaps or overlaps,
// and a Gaussian, which counts only in the cell that contains its peak, counts once.
//
// trace.glsl explains the form of loops for lavapipe.
#ifndef POINTRT_SHADERS_GAUSSIAN_WALK_GLSL
#define POINTRT_SHADERS_GAUSSIAN_WALK_GLSL
#include "shaders/shared/gaussian_layout.h"
#include "shaders/trace/clip.glsl"
#include "shaders/trace/gaussian_end.glsl"
#include "shaders/trace/instance.glsl"

#define loadGaussianNode(i) loadNearPair(i)
#define loadGaussianListed(i) loadBrickWord(i)
#define loadGaussianRow(i, row) uintBitsToFloat(loadSplat((i) * GAUSSIAN_VECTORS + (row)))

// A ray in the cube, measured from where it enters the cube: from a distant origin, too few bits would be left.
struct GaussianRay {
    vec3 origin;
    vec3 direction; // unit length
    float t_start;  // distance of that point from the ray's own origin
    // relative to that point: the ray's own origin, or where the ray enters the part that clips keep; earlier peaks do
    // not count
    float t_min;
    float t_max;    // relative to that point
};

struct GaussianWalk {
    vec3 inverse;  // of the direction
    vec3 positive; // 1 where the direction is not negative, else 0
    ivec3 cell;    // the node's cell, in units of its edge
    float edge;    // cube units
    float t;       // distance at which the ray enters the node; kWalkEnded after the last node
    uint number;   // number of the node
    uvec4 node;    // GaussianNode
    bool leaves;   // the node's children have been visited
};

// The ray of the cube. Clips cut Gaussians at their peaks along the ray.
GaussianRay gaussianRayInCube(vec3 from, vec3 way, float t_max, out bool enters) {
    vec3 inverse = 1.0 / mix(way, vec3(1e-20), lessThan(abs(way), vec3(1e-20)));
    vec3 to_low = -from * inverse, to_high = (1.0 - from) * inverse;
    vec3 near = min(to_low, to_high), far = max(to_low, to_high);
    float first = max(max(near.x, near.y), near.z), last = min(min(far.x, far.y), far.z);
    vec2 kept = kClipped ? keptInterval(from, way) : vec2(0.0);
    if (kClipped) t_max = min(t_max, kept.y);
    enters = first <= last && last > 0.0 && first < t_max;
    // rays that miss the cube start where they pass its centre
    float t_start = max(enters ? first : dot(vec3(0.5) - from, way), 0.0);
    float t_min = kClipped ? max(kept.x, 0.0) - t_start : -t_start;
    return GaussianRay(from + t_start * way, way, t_start, t_min, t_max - t_start);
}

// The ray of render space, with t_max in cube units.
GaussianRay gaussianRay(vec3 origin, vec3 direction, float t_max, out bool enters) {
    return gaussianRayInCube(cubePoint(origin), cubeDirection(direction), t_max, enters);
}

GaussianWalk startGaussianWalk(GaussianRay ray) {
    vec3 way = mix(ray.direction, vec3(1e-20), lessThan(abs(ray.direction), vec3(1e-20)));
    vec3 positive = vec3(greaterThan(way, vec3(0.0)));
    return GaussianWalk(1.0 / way, positive, ivec3(0), 1.0, 0.0, 0u, loadGaussianNode(0u), false);
}

// Distances to the planes through which the ray leaves the cell.
vec3 exitDistances(GaussianWalk walk, vec3 origin) {
    return ((vec3(walk.cell) + walk.positive) * walk.edge - origin) * walk.inverse;
}

float leastOf(vec3 v) {
    float least = v.x < v.y ? v.x : v.y;
    return least < v.z ? least : v.z;
}

uint slotOf(ivec3 cell) {
    uvec3 bits = uvec3(cell) & 1u;
    return bits.x | bits.y << 1 | bits.z << 2;
}

// One move: down to the child that the ray enters first, on to the next sibling, or up. Returns whether it enters a
// node.
bool moveWalk(inout GaussianWalk walk, vec3 origin, bool going) {
    bool descends = !walk.leaves && walk.node.x != 0u;
    vec3 to_middle = ((vec3(walk.cell) + 0.5) * walk.edge - origin) * walk.inverse;
    ivec3 upper = ivec3(equal(lessThanEqual(to_middle, vec3(walk.t)), greaterThan(walk.positive, vec3(0.0))));
    ivec3 child = 2 * walk.cell + upper;

    vec3 exits = exitDistances(walk, origin);
    float t_out = leastOf(exits);
    ivec3 crossed = ivec3(lessThanEqual(exits, vec3(t_out)));
    ivec3 next = walk.cell + crossed * (2 * ivec3(walk.positive) - 1);
    bool at_root = walk.number == 0u;
    bool moves_on = !descends && !at_root && (next >> 1) == (walk.cell >> 1);
    bool rises = !descends && !moves_on && !at_root, ends = !descends && at_root;

    uint number = descends ? walk.node.x + slotOf(child) : moves_on ? (walk.number & ~7u) + slotOf(next) : walk.node.w;
    number = ends || !going ? walk.number : number;
    uvec4 node = loadGaussianNode(number);
    if (going) {
        walk.t = ends ? kWalkEnded : descends ? walk.t : t_out;
        walk.cell = descends ? child : moves_on ? next : walk.cell >> 1;
        walk.edge *= descends ? 0.5 : rises ? 2.0 : 1.0;
        walk.number = number;
        walk.node = node;
        walk.leaves = rises;
    }
    return going && (descends || moves_on);
}

// Where a Gaussian is opaquest along a ray.
struct GaussianPeak {
    float t;
    float distance_squared; // from its centre, in radii of the ellipsoid in which it counts
};

GaussianPeak gaussianPeak(uint gaussian, GaussianRay ray) {
    vec4 row_x = loadGaussianRow(gaussian, 0u), row_y = loadGaussianRow(gaussian, 1u);
    vec4 row_z = loadGaussianRow(gaussian, 2u);
    vec3 from = ray.origin - vec3(row_x.w, row_y.w, row_z.w);
    vec3 origin = vec3(dot(row_x.xyz, from), dot(row_y.xyz, from), dot(row_z.xyz, from));
    vec3 way = vec3(dot(row_x.xyz, ray.direction), dot(row_y.xyz, ray.direction), dot(row_z.xyz, ray.direction));
    float inverse = 1.0 / dot(way, way);
    // by the cross product: the difference of two large squares would lose thin Gaussians
    vec3 across = cross(origin, way);
    return GaussianPeak(-dot(origin, way) * inverse, dot(across, across) * inverse);
}

// Opacity of a Gaussian at its peak along a ray: o exp(-d^2 / 2), where d^2 / 2 is ln(255 o), and so the opacity 1/255,
// on the surface of the ellipsoid.
float alphaAt(float opacity, float distance_squared) {
    return min(opacity * exp2(-log2(255.0 * opacity) * distance_squared), GAUSSIAN_ALPHA_MAX);
}

#endif
