// SPDX-License-Identifier: Apache-2.0
#include "octree.glsl"

// Stackless traversal. A grid of entry points stands for the octree's upper levels: an empty cell says for each
// direction octant how many cells can be skipped, a filled one names its node. From the node down the tree is walked
// by the bits of the position. Positions are carried as 21-bit integers, and a step sets the coordinate of the axis it
// leaves by to the neighbour's exactly: no epsilon, and no leaf is jumped over. A leaf is a brick of cells, which the ray
// crosses one by one (Amanatides and Woo, A Fast Voxel Traversal Algorithm, 1987); a cell's discs are looked at only
// where the ray comes between the two planes that they lie between.
//
// Loops are written as while over state declared before them: lavapipe's do-while loses values, and an
// inner loop per phase keeps lanes that wait from costing a turn of the other phase.

struct TraceHit {
    float t;    // along the ray; unchanged when nothing is hit
    uint cell;  // whose list the hit's surroundings are in, NO_INDEX when nothing is hit
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

// Where a ray stands: in front of the leaf at position, or in a brick, and then position is behind that.
struct Walk {
    vec3 origin;    // on the grid's border or inside
    vec3 direction; // no component is 0
    vec3 inverse;
    ivec3 forward;  // 1 where the direction rises, else 0
    uint octant;
    ivec3 position; // 21-bit cell
    float t;        // from origin to where the ray enters that cell, or the brick's cell
    bool inside;    // position is in the grid
    bool in_brick;
    uvec4 brick;
    vec4 place;     // brickPlace
    ivec3 cell;     // of the brick
    vec3 t_planes;  // to where the ray leaves the cell by each axis
    float t_leave;  // to where it leaves the brick
};

// Starts at the grid's border: from a distant eye t would leave too few bits for the splat test.
// t_start receives the distance from the ray's origin.
Walk startWalk(TraceRay ray, out float t_start) {
    Walk walk;
    // smaller components would make inverses whose products are not numbers
    walk.direction = mix(ray.direction, vec3(1e-20), lessThan(abs(ray.direction), vec3(1e-20)));
    walk.inverse = 1.0 / walk.direction;
    walk.forward = ivec3(greaterThan(walk.direction, vec3(0.0)));
    walk.octant = uint(walk.forward.x | walk.forward.y << 1 | walk.forward.z << 2);
    vec3 lo = vec3(gridBegin()) * PRO_POSITION_STEP, hi = vec3(gridEnd()) * PRO_POSITION_STEP;
    bvec3 rising = equal(walk.forward, ivec3(1));
    vec3 near = (mix(hi, lo, rising) - ray.origin) * walk.inverse;
    vec3 far = (mix(lo, hi, rising) - ray.origin) * walk.inverse;
    t_start = max(max(near.x, near.y), max(near.z, 0.0));
    walk.inside = t_start <= min(min(far.x, far.y), far.z);
    walk.origin = ray.origin + ray.direction * t_start;
    walk.position = clamp(ivec3(walk.origin * PRO_POSITION_STEPS), gridBegin(), gridEnd() - 1);
    walk.t = 0.0;
    walk.in_brick = false;
    return walk;
}

// Enters the brick at the ray's position, or passes the empty cells there; position moves on behind it.
void enterLeaf(inout Walk walk) {
    int shift = gridShift();
    ivec3 cell = walk.position >> shift;
    uint word = gridWord(cell);
    int skip = skipCells(word, walk.octant);
    // where the ray leaves by each axis: the far side of the skipped cells, or of the leaf
    ivec3 plane = (cell + walk.forward * (2 * skip - 1) - (skip - 1)) << shift;
    if (isFilled(word)) {
        uint leaf = findLeaf(word, walk.position, shift);
        walk.in_brick = leaf != NO_INDEX;
        if (walk.in_brick) {
            walk.brick = loadBrick(leaf);
            walk.place = brickPlace(walk.brick, walk.position);
            shift = int(walk.brick[BRICK_SHIFT]);
        }
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
    walk.inside = any(leaving) && inGrid(walk.position);
    walk.t_leave = t_exit;
    if (walk.in_brick) {
        walk.cell = brickCell(walk.place, walk.origin + walk.direction * walk.t);
        vec3 planes = walk.place.xyz + vec3(walk.cell + walk.forward) * (walk.place.w / float(BRICK_SIDE));
        walk.t_planes = (planes - walk.origin) * walk.inverse;
    } else walk.t = t_exit;
}

// Whether the ray comes near the discs of the cell between t_in and t_out.
bool meetsSlab(Walk walk, uvec4 cell, float t_in, float t_out) {
    uvec3 code = uvec3(cell[CELL_NORMAL], cell[CELL_NORMAL] >> CELL_NORMAL_BITS,
                       cell[CELL_NORMAL] >> (2u * CELL_NORMAL_BITS)) & CELL_NORMAL_MASK;
    vec3 normal = vec3(code) * (1.0 / CELL_NORMAL_ZERO) - 1.0;
    float edges = float(BRICK_SIDE) / walk.place.w;
    vec3 middle = walk.place.xyz + (vec3(walk.cell) + 0.5) * (walk.place.w / float(BRICK_SIDE));
    float base = dot(normal, walk.origin - middle) * edges, slope = dot(normal, walk.direction) * edges;
    float near = base + slope * t_in, far = base + slope * t_out;
    vec2 slab = unpackHalf2x16(cell[CELL_SLAB]); // the second is the negated upper end
    return max(near, far) >= slab.x && -min(near, far) >= slab.y;
}

// Crosses one cell of the brick. Returns its number where discs can be hit in it, else NO_INDEX.
uint crossCell(inout Walk walk, out uvec4 cell) {
    float t_out = max(min(walk.t_planes.x, min(walk.t_planes.y, walk.t_planes.z)), walk.t);
    uint found = listedCell(walk.brick, walk.cell);
    cell = uvec4(0u);
    if (found != NO_INDEX) {
        cell = loadCell(found);
        if (!meetsSlab(walk, cell, walk.t, t_out)) found = NO_INDEX;
    }
    bvec3 leaving = lessThanEqual(walk.t_planes, vec3(t_out));
    walk.cell += mix(ivec3(0), 2 * walk.forward - 1, leaving);
    walk.t_planes += mix(vec3(0.0), abs(walk.inverse) * (walk.place.w / float(BRICK_SIDE)), leaving);
    walk.in_brick = any(leaving) && all(greaterThanEqual(walk.cell, ivec3(0))) &&
                    all(lessThan(walk.cell, ivec3(BRICK_SIDE)));
    walk.t = walk.in_brick ? t_out : walk.t_leave;
    return found;
}

TraceHit trace(TraceRay ray) {
    float t_start;
    Walk walk = startWalk(ray, t_start);
    TraceHit hit = TraceHit(ray.t_max - t_start, NO_INDEX, NO_INDEX);
    float own_t = ray.own_t - t_start;
    uint last_cell = NO_INDEX;
    bool searching = walk.inside && hit.t > 0.0;

    while (searching) {
        uint found = NO_INDEX;
        uvec4 cell = uvec4(0u);
        while (searching && found == NO_INDEX) {
            if (!walk.in_brick) enterLeaf(walk);
            if (walk.in_brick) found = crossCell(walk, cell);
            searching = (walk.inside || walk.in_brick) && walk.t < hit.t;
        }
        last_cell = found == NO_INDEX ? last_cell : found;
        uint k = cell[CELL_FIRST];
        uint end = found == NO_INDEX ? k : k + hittableCount(cell);
        while (k < end) {
            uint splat = loadListed(k);
            float t_hit = hitSplat(loadSplat(splat), walk.origin, ray, own_t, -t_start, hit.t);
            if (t_hit < hit.t) {
                hit.t = t_hit;
                hit.splat = splat;
#ifdef ANY_HIT
                searching = false;
                end = k;
#endif
            }
            k++;
        }
        searching = searching && walk.t < hit.t;
    }
    hit.cell = hit.splat == NO_INDEX ? NO_INDEX : last_cell;
    hit.t += t_start;
    return hit;
}
