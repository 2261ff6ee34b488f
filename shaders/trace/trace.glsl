// SPDX-License-Identifier: Apache-2.0
#include "shaders/trace/entry_grid.glsl"
#include "shaders/trace/cell_list.glsl"
#include "shaders/trace/instance.glsl"

// Stackless traversal, in grid units. Each step finds the cell that the ray enters and passes it: an empty one with as
// many more as its word allows in the ray's direction octant, a listed one by itself; its discs are looked at only
// where the ray comes between the two planes that hold them there. Of all that only t is carried from step to step:
// the ray looks one position step ahead, and the lists take in what that passes over.
//
// On lavapipe a loop runs its body once more after the last lane has left, unless that is asked at the end; and a lane
// that has left takes part until all have. So loops are do-while, and what is used after them is selected by
// conditions of the lane's own (values that merely were computed in a do-while are wrong for such lanes).

struct TraceHit {
    float t;   // along the ray to the cell disc: rounded, exactDistance knows better; t_max when nothing is hit
    uint cell; // whose list the hit's surroundings are in
    uint disc; // the near splat, NO_INDEX when nothing is hit
};

// A ray in cube units and what its own surface is: hits nearer than own_t on discs facing like own_normal are ignored,
// and where normals are not oriented on those facing the other way as well. Only discs that the ray crosses the way it
// left its surface are its own: from hollows it comes back to the same surface, sooner than own_t at grazing angles.
struct TraceRay {
    vec3 origin;
    vec3 direction;
    float t_min; // nothing is nearer
    float t_max;
    vec3 own_normal;
    float own_t;
};

// A ray on its way; only t changes. Lengths along it are in cube units, all else in grid units.
struct Walk {
    vec3 origin;    // on the grid's border or inside
    vec3 direction; // no component is 0
    vec3 inverse;
    vec3 start;     // one position step from origin towards where the ray goes, by each axis
    vec3 entry;     // 0 where the direction rises, else 1: the planes by which a ray comes into a cell
    vec3 pace;      // from plane to plane, of cells with an edge of 1
    uint octant_shift;
    float t;        // from origin to where the ray enters the next cell
    float t_end;    // to where it leaves the grid
    vec2 t_core;    // of a tile: to where it comes into the core, and leaves it
};

// A cell whose discs the ray may hit, as a step leaves it.
struct Visit {
    uint cell; // NO_INDEX: none
    vec3 middle;
    float edge;
};

// The ray in position codes from a cell's centre.
struct CellRay {
    vec3 origin;
    vec3 direction;
    float own_slope; // against the normal of its own surface
    vec2 t_core;     // as of a Walk
};

// Starts at the grid's border, of a tile at its core's: from a distant eye t would leave too few bits for the splat test.
// t_start receives the distance from the ray's origin.
Walk startWalk(TraceRay ray, out float t_start) {
    float scale = instance.grid_scale.x;
    Walk walk;
    // smaller components would make inverses whose products are not numbers
    walk.direction = mix(ray.direction, vec3(1e-20), lessThan(abs(ray.direction), vec3(1e-20))) * scale;
    walk.inverse = 1.0 / walk.direction;
    bvec3 rising = greaterThan(walk.direction, vec3(0.0));
    walk.entry = vec3(not(rising));
    walk.pace = abs(walk.inverse);
    vec3 side = 1.0 - 2.0 * walk.entry; // signs of the direction
    uvec3 bits = uvec3(rising);
    walk.octant_shift = PRO_SKIP_BITS * (bits.x | bits.y << 1 | bits.z << 2);
    vec3 origin = gridPoint(ray.origin), lowest, highest;
    walkedBox(origin, lowest, highest);
    vec3 near = (mix(highest, lowest, rising) - origin) * walk.inverse;
    // ends before looking ahead leaves the grid, by no more than the lists take in around a cell (kSlackSteps)
    vec3 last = mix(lowest, highest, rising) - 1.5 * instance.grid_scale.y * side;
    vec3 far = (last - origin) * walk.inverse;
    t_start = max(max(near.x, near.y), max(near.z, ray.t_min));
    // from a distant origin the product's rounding may put it outside, where words are those of other cells
    walk.origin = clamp(origin + walk.direction * t_start, lowest, highest);
    walk.start = walk.origin + side * instance.grid_scale.y;
    walk.t = 0.0;
    walk.t_end = min(min(far.x, far.y), far.z) - t_start;
    walk.t_core = kCored ? vec2(max(max(near.x, near.y), near.z) - t_start, walk.t_end) : vec2(0.0);
    return walk;
}

// Whether the ray comes between the planes that hold the discs' parts in a cell, from t to t_out.
bool meetsSlab(Walk walk, uint slab, vec3 middle, float edge, float t_out) {
    const int top = 32 - PRO_SLAB_NORMAL_BITS, height_top = 32 - PRO_SLAB_HEIGHT_BITS;
    vec3 normal = vec3(ivec3(slab) << (top - PRO_SLAB_NORMAL_BITS * ivec3(0, 1, 2)) >> top);
    float lo = float(int(slab) << PRO_SLAB_HEIGHT_BITS >> height_top), hi = float(int(slab) >> height_top);
    float base = dot(normal, walk.origin - middle);
    float slope = dot(normal, walk.direction);
    float near = base + slope * walk.t, far = base + slope * t_out;
    float unit = edge * (float(PRO_SLAB_NORMAL_MAX) / PRO_SLAB_STEPS);
    return (near > far ? near : far) >= lo * unit && (near < far ? near : far) <= hi * unit;
}

// To where the ray leaves the cell, and the empty ones that follow.
float leaveSpot(Walk walk, Spot spot) {
    float cells = isFilled(spot.word) ? 1.0 : skippedCells(spot.word, walk.octant_shift);
    // From the plane that is known before the word: on CPUs, what follows a load is what a step takes. The sum is off
    // by 2^-24 of the grid's size at most, along the plane's axis, an eighth of the position step that lists take in.
    vec3 t_entry = ((spot.base + walk.entry) * spot.edge - walk.origin) * walk.inverse;
    vec3 t_planes = t_entry + cells * (spot.edge * walk.pace);
    float t_out = t_planes.x < t_planes.y ? t_planes.x : t_planes.y;
    t_out = t_out < t_planes.z ? t_out : t_planes.z;
    // never less than a quarter step onwards: rounding at a border must not hold the ray up
    float t_least = walk.t + 0.25 * PRO_POSITION_STEP;
    return t_out > t_least ? t_out : t_least;
}

// One step: passes the cell that the ray enters at t, and the empty ones that follow, up to t_out.
Visit stepWalk(Walk walk, Grid grid, out float t_out) {
    // One position step ahead: more than rounding, so that a ray at a border is in the cell behind it and moves on.
    Spot spot = spotAt(walk.start + walk.direction * walk.t, grid);
    t_out = leaveSpot(walk, spot);
    bool listed = isFilled(spot.word);
    uint cell = listed ? spot.word >> PRO_CELL_INDEX_SHIFT : 0u;
    vec3 middle = (spot.base + 0.5) * spot.edge;
    bool meets = listed && meetsSlab(walk, loadSlab(cell), middle, spot.edge, t_out);
    return Visit(meets ? cell : NO_INDEX, middle, spot.edge);
}

// Of a radius, as far as near splats of the same disc lie apart in two tiles: each is less than a hundredth off.
const float kCoreSlack = 1.0 / 32.0;

// Whether a tile's hit counts: in its core, or where at the core's border the ray is so near to the disc that the
// neighbour's near splat may lie beyond it. With rays that graze the disc that is far along the ray.
bool countsInCore(float t, float slope, float normal_squared, float radius_squared, vec2 t_core) {
    float height = (t - clamp(t, t_core.x, t_core.y)) * slope;
    return height * height <= kCoreSlack * kCoreSlack * normal_squared * radius_squared;
}

// Distance to a cell disc along the ray, or t_limit where it is missed, not nearer, or the ray's own surface.
float hitDisc(uvec2 words, CellRay cell_ray, TraceRay ray, float t_start, float t_limit) {
    const ivec3 axes = ivec3(0, 1, 2);
    vec3 center = vec3(ivec3(int(words.x)) << (PRO_NEAR_POSITION_BITS * axes) >> (32 - PRO_NEAR_POSITION_BITS));
    vec3 normal = vec3(ivec3(int(words.y)) << (PRO_NEAR_NORMAL_BITS * axes) >> (32 - PRO_NEAR_NORMAL_BITS));
    uint radius_high = words.x & PRO_NEAR_RADIUS_HIGH_MASK, radius_low = words.y & PRO_NEAR_RADIUS_LOW_MASK;
    uint radius_code = radius_high << PRO_NEAR_RADIUS_LOW_BITS | radius_low;
    float radius_squared = uintBitsToFloat((radius_code << PRO_NEAR_RADIUS_SHIFT) + PRO_NEAR_RADIUS_BIAS);
    vec3 to_center = center - cell_ray.origin;
    float slope = dot(normal, cell_ray.direction);
    float t = dot(normal, to_center) / slope;
    vec3 offset = cell_ray.direction * t - to_center;
    float facing = dot(normal, ray.own_normal);
    bool own = t < ray.own_t - t_start && facing * (kOriented ? abs(facing) : facing) > 0.25 * dot(normal, normal) &&
               slope * facing * cell_ray.own_slope > 0.0;
    bool hits = dot(offset, offset) < radius_squared && t >= -t_start && t < t_limit && !own;
    if (kCored) hits = hits && countsInCore(t, slope, dot(normal, normal), radius_squared, cell_ray.t_core);
    return hits ? t : t_limit;
}

bool walks(Walk walk, Visit visit, float t_end) { return visit.cell == NO_INDEX && walk.t < t_end; }

// On to the next cell whose discs the ray may hit; none before t_end leaves visit.cell at NO_INDEX.
Visit nextVisit(inout Walk walk, Grid grid, float t_end) {
    Visit visit = Visit(NO_INDEX, vec3(0.0), 1.0);
    do {
        bool going = walks(walk, visit, t_end);
        float t_out;
        Visit next = stepWalk(walk, grid, t_out);
        walk.t = going ? t_out : walk.t;
        visit.cell = going ? next.cell : visit.cell;
        visit.middle = going ? next.middle : visit.middle;
        visit.edge = going ? next.edge : visit.edge;
    } while (walks(walk, visit, t_end));
    return visit;
}

// The near splats k and k + 1, k even; going: whether this lane has such.
void testPair(uint k, bool going, CellRay cell_ray, TraceRay ray, float t_start, inout TraceHit hit) {
    uvec4 pair = loadNearPair((going ? k : 0u) >> 1);
    float first = hitDisc(pair.xy, cell_ray, ray, t_start, hit.t);
    float second = hitDisc(pair.zw, cell_ray, ray, t_start, first);
    bool nearer = going && second < hit.t;
    hit.disc = nearer ? (second < first ? k + 1u : k) : hit.disc;
    hit.t = nearer ? second : hit.t;
}

// The nearest hit in a visited cell, if it is nearer than hit. hit.t is from the walk's origin.
void testCell(Walk walk, Visit visit, TraceRay ray, float t_start, inout TraceHit hit) {
    bool visits = visit.cell != NO_INDEX;
    uvec4 cell = loadCell(visits ? visit.cell : 0u);
    float codes = unpackHalf2x16(cell[PRO_CELL_COUNT] >> PRO_CELL_CODES_SHIFT).x / visit.edge;
    vec3 middle = visit.middle + middleOffset(cell[PRO_CELL_BLENDING_COUNT]) * (0.5 * visit.edge);
    CellRay cell_ray = CellRay((walk.origin - middle) * codes, walk.direction * codes,
                               dot(walk.direction, ray.own_normal), walk.t_core);
    // runs start and end where they will: what is tested beside them are discs as well
    uint first = cell[PRO_CELL_FIRST], end = visits ? first + (cell[PRO_CELL_COUNT] & PRO_CELL_COUNT_MASK) : 0u;
    uint k = visits ? first & ~1u : 0u;
    float t_before = hit.t;
    do {
        bool going = k < end;
        testPair(k, going, cell_ray, ray, t_start, hit);
        k = going ? k + 2u : k;
#ifdef ANY_HIT
        end = hit.disc != NO_INDEX ? 0u : end;
#endif
    } while (k < end);
    hit.cell = hit.t < t_before ? visit.cell : hit.cell;
}

TraceHit trace(TraceRay ray) {
    Grid grid = loadGridFrame();
    float t_start;
    Walk walk = startWalk(ray, t_start);
    TraceHit hit = TraceHit(ray.t_max - t_start, NO_INDEX, NO_INDEX);
    float t_end = hit.t < walk.t_end ? hit.t : walk.t_end; // not min: a NaN must end the walk
    do {
        Visit visit = nextVisit(walk, grid, t_end);
        testCell(walk, visit, ray, t_start, hit);
        t_end = hit.t < t_end ? hit.t : t_end;
#ifdef ANY_HIT
        t_end = hit.disc != NO_INDEX ? -1.0 : t_end;
#endif
    } while (walk.t < t_end);
    hit.t += t_start;
    return hit;
}
