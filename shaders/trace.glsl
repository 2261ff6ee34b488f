// SPDX-License-Identifier: Apache-2.0
#include "octree.glsl"

// Stackless traversal. A grid of entry points stands for the octree's upper levels: an empty cell says for each
// direction octant how many cells can be skipped, a filled one names its node. From the node down the tree is walked
// by the bits of the position. Positions are carried as 21-bit integers, and a step sets the coordinate of the axis it
// leaves by to the neighbour's exactly: no epsilon, and no cell is jumped over. (A leaf larger than a grid cell is met
// once in each of its grid cells.)
//
// Loops are written as while over state declared before them: lavapipe's do-while loses values, and an
// inner loop per phase keeps lanes that wait from costing a turn of the other phase.

struct TraceHit {
    float t;    // along the ray; unchanged when nothing is hit
    uint leaf;  // whose list the hit's surroundings are in, NO_INDEX when nothing is hit
    uint splat;
};

// A ray and what its own surface is: hits nearer than own_t on discs facing like own_normal are ignored.
struct TraceRay {
    vec3 origin;
    vec3 direction;
    float t_max;
    vec3 own_normal;
    float own_t;
};

// Distance to the disc along the ray, or t_limit where it is missed, not nearer, or the ray's own surface.
float hitSplat(uvec4 words, vec3 origin, TraceRay ray, float own_t, float t_min, float t_limit) {
    vec3 normal = splatDirection(words);
    vec3 to_center = splatPosition(words) - origin;
    float t = dot(normal, to_center) / dot(normal, ray.direction);
    vec3 offset = ray.direction * t - to_center;
    float radius = splatRadius(words);
    float facing = dot(normal, ray.own_normal);
    bool own = t < own_t && facing * facing > 0.25 * dot(normal, normal);
    return dot(offset, offset) < radius * radius && t >= t_min && t < t_limit && !own ? t : t_limit;
}

// Cells to skip from an empty grid cell: the nibble of the ray's direction octant.
int skipCells(uint word, uint octant) { return int((word >> (4u * octant)) & 15u); }

// Where a ray stands in the octree.
struct Walk {
    vec3 origin;    // on the cube's border or inside
    vec3 direction; // no component is 0
    vec3 inverse;
    ivec3 forward;  // 1 where the direction rises, else 0
    uint octant;
    ivec3 position; // 21-bit cell
    float t;        // from origin to where the ray enters that cell
    bool inside;
};

// Starts at the cube's border: from a distant eye t would leave too few bits for the splat test.
// t_start receives the distance from the ray's origin.
Walk startWalk(TraceRay ray, out float t_start) {
    Walk walk;
    // smaller components would make inverses whose products are not numbers
    walk.direction = mix(ray.direction, vec3(1e-20), lessThan(abs(ray.direction), vec3(1e-20)));
    walk.inverse = 1.0 / walk.direction;
    walk.forward = ivec3(greaterThan(walk.direction, vec3(0.0)));
    walk.octant = uint(walk.forward.x | walk.forward.y << 1 | walk.forward.z << 2);
    vec3 near = (vec3(1 - walk.forward) - ray.origin) * walk.inverse;
    vec3 far = (vec3(walk.forward) - ray.origin) * walk.inverse;
    t_start = max(max(near.x, near.y), max(near.z, 0.0));
    walk.inside = t_start <= min(min(far.x, far.y), far.z);
    walk.origin = ray.origin + ray.direction * t_start;
    walk.position = clamp(ivec3(walk.origin * PRO_POSITION_STEPS), ivec3(0), ivec3(kLastCell));
    walk.t = 0.0;
    return walk;
}

// One step: finds the leaf or the empty cells at the ray's position and moves on behind them.
// Returns the leaf's index, NO_INDEX where there is none.
uint stepWalk(inout Walk walk) {
    int shift = kFullDepth - int(params.grid.x);
    ivec3 cell = walk.position >> shift;
    uint word = gridWord(cell);
    int skip = skipCells(word, walk.octant);
    uint leaf = NO_INDEX;
    // where the ray leaves by each axis: the far side of the skipped cells, or of the leaf
    ivec3 plane = (cell + walk.forward * (2 * skip - 1) - (skip - 1)) << shift;
    if (isFilled(word)) {
        leaf = findLeaf(word, walk.position, shift);
        plane = ((walk.position >> shift) + walk.forward) << shift;
    }
    vec3 t_planes = (vec3(plane) * PRO_POSITION_STEP - walk.origin) * walk.inverse;
    float t_exit = max(min(t_planes.x, min(t_planes.y, t_planes.z)), walk.t);
    bvec3 leaving = lessThanEqual(t_planes, vec3(t_exit));
    // on the axes it does not leave by, the ray stays on this side of the plane and never turns back
    bvec3 falling = equal(walk.forward, ivec3(0));
    ivec3 exit_cell = ivec3((walk.origin + walk.direction * t_exit) * PRO_POSITION_STEPS);
    ivec3 limit = plane - walk.forward;
    ivec3 ahead = mix(max(exit_cell, walk.position), min(exit_cell, walk.position), falling);
    ahead = mix(min(ahead, limit), max(ahead, limit), falling);
    walk.position = mix(ahead, plane + walk.forward - 1, leaving);
    walk.t = t_exit;
    walk.inside = any(leaving) && all(greaterThanEqual(walk.position, ivec3(0))) &&
                  all(lessThanEqual(walk.position, ivec3(kLastCell)));
    return leaf;
}

TraceHit trace(TraceRay ray) {
    float t_start;
    Walk walk = startWalk(ray, t_start);
    TraceHit hit = TraceHit(ray.t_max - t_start, NO_INDEX, NO_INDEX);
    float own_t = ray.own_t - t_start;
    uint last_leaf = NO_INDEX;
    bool searching = walk.inside && hit.t > 0.0;

    while (searching) {
        uint leaf_index = NO_INDEX;
        while (searching && leaf_index == NO_INDEX) {
            leaf_index = stepWalk(walk);
            searching = walk.inside && walk.t < hit.t;
        }
        uvec4 leaf = leaf_index == NO_INDEX ? uvec4(0u) : loadLeaf(leaf_index);
        last_leaf = leaf_index == NO_INDEX ? last_leaf : leaf_index;
        uint count = listLength(leaf);
        uint k = 0u;
        while (k < count) {
            uint splat = listedSplat(leaf, k);
            float t_hit = hitSplat(loadSplat(splat), walk.origin, ray, own_t, -t_start, hit.t);
            if (t_hit < hit.t) {
                hit.t = t_hit;
                hit.splat = splat;
#ifdef ANY_HIT
                searching = false;
                count = 0u;
#endif
            }
            k++;
        }
        searching = searching && walk.t < hit.t;
    }
    hit.leaf = hit.splat == NO_INDEX ? NO_INDEX : last_leaf;
    hit.t += t_start;
    return hit;
}
