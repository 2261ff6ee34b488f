// SPDX-License-Identifier: Apache-2.0
#include "octree.glsl"

// Stackless traversal. A grid of entry points stands for the octree's upper levels: an empty cell says for each
// direction octant how many cells can be skipped, a filled one names its leaf or node. From a node down the tree is
// walked by the bits of the position. A leaf is a brick of cells, which the ray crosses one by one; a cell's discs are
// looked at only where the ray comes between the two planes that they lie between. Of all that only t is carried from
// step to step: the ray looks one position step ahead, and the lists take in what that passes over.
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

// A ray on its way; only t changes.
struct Walk {
    vec3 origin;   // on the grid's border or inside
    vec3 direction; // no component is 0
    vec3 inverse;
    vec3 ahead;    // one position step towards where the ray goes, by each axis
    ivec3 forward; // 1 where the direction rises, else 0
    uint octant;
    float t;       // from origin to where the ray enters the next cell
    float t_end;   // to where it leaves the grid
};

// Starts at the grid's border: from a distant eye t would leave too few bits for the splat test.
// t_start receives the distance from the ray's origin.
Walk startWalk(TraceRay ray, out float t_start) {
    Walk walk;
    // smaller components would make inverses whose products are not numbers
    walk.direction = mix(ray.direction, vec3(1e-20), lessThan(abs(ray.direction), vec3(1e-20)));
    walk.inverse = 1.0 / walk.direction;
    bvec3 rising = greaterThan(walk.direction, vec3(0.0));
    walk.forward = ivec3(rising);
    walk.ahead = vec3(2 * walk.forward - 1) * PRO_POSITION_STEP;
    walk.octant = uint(walk.forward.x | walk.forward.y << 1 | walk.forward.z << 2);
    vec3 lo = vec3(gridBegin()) * PRO_POSITION_STEP, hi = vec3(gridEnd()) * PRO_POSITION_STEP;
    vec3 near = (mix(hi, lo, rising) - ray.origin) * walk.inverse;
    vec3 far = (mix(lo, hi, rising) - ray.origin) * walk.inverse;
    t_start = max(max(near.x, near.y), max(near.z, 0.0));
    walk.origin = ray.origin + ray.direction * t_start;
    walk.t = 0.0;
    walk.t_end = min(min(far.x, far.y), far.z) - t_start;
    return walk;
}

// Whether the ray comes near the discs of the cell with this corner and edge between t_in and t_out.
bool meetsSlab(Walk walk, uvec4 cell, vec3 corner, float edge, float t_out) {
    uvec3 code = uvec3(cell[CELL_NORMAL], cell[CELL_NORMAL] >> CELL_NORMAL_BITS,
                       cell[CELL_NORMAL] >> (2u * CELL_NORMAL_BITS)) & CELL_NORMAL_MASK;
    vec3 normal = vec3(code) * (1.0 / CELL_NORMAL_ZERO) - 1.0;
    float base = dot(normal, walk.origin - corner) - 0.5 * edge * (normal.x + normal.y + normal.z);
    float slope = dot(normal, walk.direction);
    float near = base + slope * walk.t, far = base + slope * t_out;
    vec2 slab = unpackHalf2x16(cell[CELL_SLAB]) * edge; // the second is the negated upper end
    return max(near, far) >= slab.x && -min(near, far) >= slab.y;
}

// One step: passes the empty cells, or the brick's cell, that the ray enters at t.
// Returns the number of a cell whose discs the ray may hit and puts its words into cell, else NO_INDEX.
uint stepWalk(inout Walk walk, inout uvec4 cell) {
    // One position step ahead: more than rounding, so that a ray at a border is in the cell behind it and moves on.
    vec3 point = walk.origin + walk.direction * walk.t + walk.ahead;
    ivec3 position = clamp(ivec3(point * PRO_POSITION_STEPS), gridBegin(), gridEnd() - 1);
    int shift = gridShift();
    ivec3 grid_cell = position >> shift;
    uint word = gridWord(grid_cell);
    int skip = skipCells(word, walk.octant);
    // where the ray leaves by each axis: the far side of the skipped cells, of an empty leaf, or of the brick's cell
    vec3 plane = vec3((grid_cell + walk.forward * (2 * skip - 1) - (skip - 1)) << shift) * PRO_POSITION_STEP;
    uint found = NO_INDEX;
    vec3 corner = vec3(0.0);
    float edge = 0.0;
    if (isFilled(word)) {
        uint leaf = findLeaf(word, position, shift);
        plane = vec3(((position >> shift) + walk.forward) << shift) * PRO_POSITION_STEP;
        if (leaf != NO_INDEX) {
            uvec4 brick = loadBrick(leaf);
            vec4 place = brickPlace(brick, position);
            ivec3 part = brickCell(place, point);
            edge = place.w * (1.0 / float(BRICK_SIDE));
            corner = place.xyz + vec3(part) * edge;
            plane = corner + vec3(walk.forward) * edge;
            found = listedCell(brick, part);
        }
    }
    vec3 t_planes = (plane - walk.origin) * walk.inverse;
    // never less than a quarter step onwards: rounding at a border must not hold the ray up
    float t_out = max(min(t_planes.x, min(t_planes.y, t_planes.z)), walk.t + 0.25 * PRO_POSITION_STEP);
    if (found != NO_INDEX) {
        cell = loadCell(found);
        if (!meetsSlab(walk, cell, corner, edge, t_out)) found = NO_INDEX;
    }
    walk.t = t_out;
    return found;
}

TraceHit trace(TraceRay ray) {
    float t_start;
    Walk walk = startWalk(ray, t_start);
    TraceHit hit = TraceHit(ray.t_max - t_start, NO_INDEX, NO_INDEX);
    float own_t = ray.own_t - t_start;
    float t_end = hit.t < walk.t_end ? hit.t : walk.t_end; // not min: a NaN must end the walk
    uint last_cell = NO_INDEX;

    while (walk.t < t_end) {
        uint found = NO_INDEX;
        uvec4 cell = uvec4(0u);
        while (found == NO_INDEX && walk.t < t_end) found = stepWalk(walk, cell);
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
                t_end = -1.0;
                end = k;
#endif
            }
            k++;
        }
        t_end = min(t_end, hit.t);
    }
    hit.cell = hit.splat == NO_INDEX ? NO_INDEX : last_cell;
    hit.t += t_start;
    return hit;
}
