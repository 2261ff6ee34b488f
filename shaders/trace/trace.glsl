// SPDX-License-Identifier: Apache-2.0
#include "shaders/trace/entry_grid.glsl"
#include "shaders/trace/cell_list.glsl"
#include "shaders/trace/clip.glsl"
#include "shaders/trace/instance.glsl"

// Ray traversal of one instance: stackless, in grid units. Each step finds the cell that the ray enters and passes it:
// an empty cell together with as many more as its word allows in the ray's direction octant, a filled cell alone. The
// discs of a filled cell are tested only if the ray enters the slab between the two planes that bound them in the cell.
// The only state from step to step is t: the ray looks one position step ahead, and the lists of cells include the
// splats that this skips.
//
// On lavapipe, a loop runs its body once more after the last lane has left, unless the condition is tested at the end;
// and a lane that has left takes part until all lanes have left. So loops are do-while, and results used after a loop
// are selected by the lane's own condition (values merely computed in a do-while are wrong for such lanes).

struct TraceHit {
    float t;   // along the ray to the quantized cell disc or ball (exactDistance refines it); t_max for a miss
    uint cell; // the cell whose list holds it
    uint disc; // the near splat, NO_INDEX for a miss
};

// A ray in cube units. Self-intersection: hits nearer than self_t are ignored on discs that face like self_normal, and
// without oriented normals also on discs that face the opposite way. Only discs that the ray crosses in the direction
// in which it left its surface count as self: in hollows, rays return to the same surface, at grazing angles within
// self_t.
struct TraceRay {
    vec3 origin;
    vec3 direction;
    float t_min; // hits nearer than this are ignored
    float t_max;
    vec3 self_normal;
    float self_t;
};

// State of a traversal; only t changes. Lengths along the ray are in cube units, all else in grid units.
struct Walk {
    vec3 origin;    // on the border of the grid or inside it
    vec3 direction; // no component is 0
    vec3 inverse;
    vec3 start;     // origin moved one position step along the ray's sign in each axis
    vec3 entry;     // 0 where the direction is positive, else 1: the planes through which a ray enters a cell
    vec3 pace;      // t from plane to plane, for cells with an edge of 1
    uint octant_shift;
    float t;        // from origin to where the ray enters the next cell
    float t_end;    // t at which it leaves the grid
    float t_least;  // clips: t of the ray's origin, or where it enters the part that they keep
    vec2 t_core;    // tiles: t at which it enters the core, and leaves it
};

// A cell whose discs the ray may hit, the result of a step.
struct Visit {
    uint cell; // NO_INDEX: none
    vec3 middle;
    float edge;
};

// The ray in position codes, relative to the centre of a cell.
struct CellRay {
    vec3 origin;
    vec3 direction;
    float self_slope; // dot product with self_normal
    float t_least;    // as in Walk
    vec2 t_core;
};

// Starts at the border of the grid, of the core of a tile, or of the part that clips keep: measured from a distant eye,
// t would leave too few bits for the splat test. kept: from keptInterval; t_start: distance from the ray's origin.
Walk startWalk(TraceRay ray, vec2 kept, out float t_start) {
    float scale = instance.grid_scale.x;
    Walk walk;
    // smaller components would give inverses with NaN products
    walk.direction = mix(ray.direction, vec3(1e-20), lessThan(abs(ray.direction), vec3(1e-20))) * scale;
    walk.inverse = 1.0 / walk.direction;
    bvec3 positive = greaterThan(walk.direction, vec3(0.0));
    walk.entry = vec3(not(positive));
    walk.pace = abs(walk.inverse);
    vec3 side = 1.0 - 2.0 * walk.entry; // signs of the direction
    uvec3 bits = uvec3(positive);
    walk.octant_shift = PRO_SKIP_BITS * (bits.x | bits.y << 1 | bits.z << 2);
    vec3 origin = gridPoint(ray.origin), lowest, highest;
    traversedBox(origin, lowest, highest);
    vec3 near = (mix(highest, lowest, positive) - origin) * walk.inverse;
    // ends before the look-ahead leaves the grid by more than the slack of the lists around a cell (kSlackSteps)
    vec3 last = mix(lowest, highest, positive) - 1.5 * instance.grid_scale.y * side;
    vec3 far = (last - origin) * walk.inverse;
    t_start = max(max(near.x, near.y), max(near.z, ray.t_min));
    if (kClipped) t_start = max(t_start, kept.x);
    // from a distant origin, rounding may put the point outside, where lookups return words of other cells
    walk.origin = clamp(origin + walk.direction * t_start, lowest, highest);
    walk.start = walk.origin + side * instance.grid_scale.y;
    walk.t = 0.0;
    walk.t_end = min(min(far.x, far.y), far.z) - t_start;
    walk.t_least = max(kept.x, 0.0) - t_start;
    walk.t_core = kClipsToCore ? vec2(max(max(near.x, near.y), near.z) - t_start, walk.t_end) : vec2(0.0);
    return walk;
}

// Whether the ray enters the slab that bounds the discs within a cell, from t to t_out.
bool entersSlab(Walk walk, uint slab, vec3 middle, float edge, float t_out) {
    const int top = 32 - PRO_SLAB_NORMAL_BITS, height_top = 32 - PRO_SLAB_HEIGHT_BITS;
    vec3 normal = vec3(ivec3(slab) << (top - PRO_SLAB_NORMAL_BITS * ivec3(0, 1, 2)) >> top);
    float lo = float(int(slab) << PRO_SLAB_HEIGHT_BITS >> height_top), hi = float(int(slab) >> height_top);
    float base = dot(normal, walk.origin - middle);
    float slope = dot(normal, walk.direction);
    float near = base + slope * walk.t, far = base + slope * t_out;
    float unit = edge * (float(PRO_SLAB_NORMAL_MAX) / PRO_SLAB_STEPS);
    return (near > far ? near : far) >= lo * unit && (near < far ? near : far) <= hi * unit;
}

// t at which the ray leaves the cell and the empty cells that follow.
float leaveSpot(Walk walk, Spot spot) {
    float cells = isFilled(spot.word) ? 1.0 : skippedCells(spot.word, walk.octant_shift);
    // From the entry plane, which is known before the word: on CPUs the latency after the load dominates a step. The
    // sum is off by at most 2^-24 of the grid's size along the plane's axis, an eighth of the position step of slack in
    // the lists.
    vec3 t_entry = ((spot.base + walk.entry) * spot.edge - walk.origin) * walk.inverse;
    vec3 t_planes = t_entry + cells * (spot.edge * walk.pace);
    float t_out = t_planes.x < t_planes.y ? t_planes.x : t_planes.y;
    t_out = t_out < t_planes.z ? t_out : t_planes.z;
    // advances by at least a quarter step, so that rounding at a border cannot stall the ray
    float t_least = walk.t + 0.25 * PRO_POSITION_STEP;
    return t_out > t_least ? t_out : t_least;
}

// One step: passes the cell that the ray enters at t, and the empty ones that follow, up to t_out.
Visit stepWalk(Walk walk, Grid grid, out float t_out) {
    // One position step ahead, which is more than rounding errors, so that a ray at a border is located in the cell
    // behind it.
    Spot spot = spotAt(walk.start + walk.direction * walk.t, grid);
    t_out = leaveSpot(walk, spot);
    bool listed = isFilled(spot.word);
    uint cell = listed ? spot.word >> PRO_CELL_INDEX_SHIFT : 0u;
    vec3 middle = (spot.base + 0.5) * spot.edge;
    bool visits = listed && entersSlab(walk, loadSlab(cell), middle, spot.edge, t_out);
    return Visit(visits ? cell : NO_INDEX, middle, spot.edge);
}

// Distance, in radii, between the quantized discs of one splat in two tiles: each is off by less than a hundredth.
const float kCoreSlack = 1.0 / 32.0;

// Clips hits to the core of a tile. A hit counts if it lies in the core, or if at the core's border the ray is so close
// to the disc that the hit on the neighbouring tile's copy of the disc may lie outside the neighbour's core. A ray that
// grazes the disc stays that close for a long way.
bool isInCore(float t, float slope, float normal_squared, float radius_squared, vec2 t_core) {
    float height = (t - clamp(t, t_core.x, t_core.y)) * slope;
    return height * height <= kCoreSlack * kCoreSlack * normal_squared * radius_squared;
}

// isInCore for a hit at t on a ball.
bool isBallInCore(float t, vec3 to_center, vec3 direction, float radius_squared, vec2 t_core) {
    vec3 offset = direction * clamp(t, t_core.x, t_core.y) - to_center;
    return abs(dot(offset, offset) - radius_squared) <= 2.0 * kCoreSlack * radius_squared;
}

// Hits before this distance do not count.
float leastDistance(CellRay cell_ray, float t_start) { return kClipped ? cell_ray.t_least : -t_start; }

// Distance to where the ray enters a cell ball, or leaves it if the ray's origin is inside; t_limit if the hit is
// missing, not nearer, or a self-intersection. Rays that leave a ball's surface do not return to it, so entering a ball
// is never a self-intersection. But the ray's origin may lie inside the quantized ball that the ray left, or inside an
// overlapping ball: leaving such a ball, on the side that self_normal faces, is a self-intersection.
//
// Clips cut balls open: a ray that enters a ball before the part that the clips keep hits the ball where it leaves it.
float hitBall(vec3 to_center, float radius_squared, CellRay cell_ray, TraceRay ray, float t_start, float t_limit) {
    float inverse = 1.0 / dot(cell_ray.direction, cell_ray.direction);
    float t_middle = dot(to_center, cell_ray.direction) * inverse;
    vec3 across = cell_ray.direction * t_middle - to_center;
    float half_squared = (radius_squared - dot(across, across)) * inverse, half_chord = sqrt(max(half_squared, 0.0));
    float t_least = leastDistance(cell_ray, t_start);
    bool inside = t_middle - half_chord < t_least;
    float t = inside ? t_middle + half_chord : t_middle - half_chord;
    float facing = dot(cell_ray.direction * t - to_center, ray.self_normal);
    bool is_self = inside && t < ray.self_t - t_start && facing > 0.0 && cell_ray.self_slope > 0.0;
    bool hits = half_squared > 0.0 && t >= t_least && t < t_limit && !is_self;
    if (kClipsToCore)
        hits = hits && isBallInCore(t, to_center, cell_ray.direction, radius_squared, cell_ray.t_core);
    return hits ? t : t_limit;
}

// Distance along the ray to a near splat, a cell disc or a ball; t_limit if the hit is missing, not nearer, or a
// self-intersection.
float hitNear(uvec2 words, CellRay cell_ray, TraceRay ray, float t_start, float t_limit) {
    const ivec3 axes = ivec3(0, 1, 2);
    vec3 center = vec3(ivec3(int(words.x)) << (PRO_NEAR_POSITION_BITS * axes) >> (32 - PRO_NEAR_POSITION_BITS));
    vec3 normal = vec3(ivec3(int(words.y)) << (PRO_NEAR_NORMAL_BITS * axes) >> (32 - PRO_NEAR_NORMAL_BITS));
    uint radius_high = words.x & PRO_NEAR_RADIUS_HIGH_MASK, radius_low = words.y & PRO_NEAR_RADIUS_LOW_MASK;
    uint radius_code = radius_high << PRO_NEAR_RADIUS_LOW_BITS | radius_low;
    float radius_squared = uintBitsToFloat((radius_code << PRO_NEAR_RADIUS_SHIFT) + PRO_NEAR_RADIUS_BIAS);
    vec3 to_center = center - cell_ray.origin;
    if (kHasBalls && words.y >> PRO_NEAR_RADIUS_LOW_BITS == 0u)
        return radius_code == 0u ? t_limit : hitBall(to_center, radius_squared, cell_ray, ray, t_start, t_limit);
    float slope = dot(normal, cell_ray.direction);
    float t = dot(normal, to_center) / slope;
    vec3 offset = cell_ray.direction * t - to_center;
    float facing = dot(normal, ray.self_normal);
    bool is_self = t < ray.self_t - t_start && facing * (kOriented ? abs(facing) : facing) > 0.25 * dot(normal, normal) &&
                   slope * facing * cell_ray.self_slope > 0.0;
    bool hits = dot(offset, offset) < radius_squared && t >= leastDistance(cell_ray, t_start) && t < t_limit && !is_self;
    if (kClipsToCore) hits = hits && isInCore(t, slope, dot(normal, normal), radius_squared, cell_ray.t_core);
    return hits ? t : t_limit;
}

bool walks(Walk walk, Visit visit, float t_end) { return visit.cell == NO_INDEX && walk.t < t_end; }

// Advances to the next cell whose discs the ray may hit; visit.cell is NO_INDEX if there is none before t_end.
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

// Tests the near splats k and k + 1, k even. going: false for idle lanes.
void testPair(uint k, bool going, CellRay cell_ray, TraceRay ray, float t_start, inout TraceHit hit) {
    uvec4 pair = loadNearPair((going ? k : 0u) >> 1);
    float first = hitNear(pair.xy, cell_ray, ray, t_start, hit.t);
    float second = hitNear(pair.zw, cell_ray, ray, t_start, first);
    bool nearer = going && second < hit.t;
    hit.disc = nearer ? (second < first ? k + 1u : k) : hit.disc;
    hit.t = nearer ? second : hit.t;
}

// Updates hit with the nearest hit in a visited cell. hit.t is measured from the origin of the walk.
void testCell(Walk walk, Visit visit, TraceRay ray, float t_start, inout TraceHit hit) {
    bool visits = visit.cell != NO_INDEX;
    uvec4 cell = loadCell(visits ? visit.cell : 0u);
    float codes = unpackHalf2x16(cell[PRO_CELL_COUNT] >> PRO_CELL_CODES_SHIFT).x / visit.edge;
    vec3 middle = visit.middle + middleOffset(cell[PRO_CELL_BLENDING_COUNT]) * (0.5 * visit.edge);
    CellRay cell_ray = CellRay((walk.origin - middle) * codes, walk.direction * codes,
                               dot(walk.direction, ray.self_normal), walk.t_least, walk.t_core);
    // lists need not start or end at pairs: the neighbouring entries that are tested with them are discs, too
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

// A ray of render space that leaves a surface of this owner, in the cube of the instance. t_max: in cube units; self_t:
// in render units.
TraceRay secondaryRay(vec3 origin, vec3 direction, float t_max, vec3 self_normal, uint owner, float self_t) {
    bool is_self = owner == instance.materials.x;
    return TraceRay(cubePoint(origin), cubeDirection(direction), 0.0, t_max, cubeDirection(self_normal),
                    is_self ? self_t * cubeScale() : 0.0);
}

// Limit of steps of a walk: as many iterations as lavapipe allows all loops. Without a limit, an endless walk would
// hang a GPU.
const uint kMostSteps = 65535u;

// Whether all components are finite, tested by their bits: compilers may assume that arithmetic yields numbers.
bool isFinite(vec3 v) {
    const uint kExponent = 0x7F800000u;
    return all(notEqual(floatBitsToUint(v) & kExponent, uvec3(kExponent)));
}

// The ray, or one that hits nothing if it is invalid.
TraceRay validRay(TraceRay ray) {
    bool valid = isFinite(ray.origin) && isFinite(ray.direction);
    ray.origin = valid ? ray.origin : vec3(0.0);
    ray.direction = valid ? ray.direction : vec3(1.0, 0.0, 0.0);
    ray.t_max = valid ? ray.t_max : -1.0;
    return ray;
}

#ifdef HARDWARE
#include "shaders/trace/query_cells.glsl"
#endif

// The closest hit; with ANY_HIT, some hit. HARDWARE: the device's ray queries find the cells instead of the walk.
TraceHit trace(TraceRay given) {
    TraceRay ray = validRay(given);
    Grid grid = loadGridFrame();
    float t_start;
    vec2 kept = kClipped ? keptInterval(ray.origin, ray.direction) : vec2(0.0);
    Walk walk = startWalk(ray, kept, t_start);
    float t_max = kClipped ? min(ray.t_max, kept.y) : ray.t_max;
    TraceHit hit = TraceHit(t_max - t_start, NO_INDEX, NO_INDEX);
    float t_end = hit.t < walk.t_end ? hit.t : walk.t_end; // not min, since a NaN must end the walk
#ifdef HARDWARE
    queryCells(walk, ray, t_start, t_end, hit);
#else
    uint steps = 0u;
    do {
#ifdef POOLED
        reloadGrid();
        grid = loadGridFrame();
#endif
        Visit visit = nextVisit(walk, grid, t_end);
#ifdef POOLED
        reloadLists();
#endif
        testCell(walk, visit, ray, t_start, hit);
        t_end = hit.t < t_end ? hit.t : t_end;
#ifdef ANY_HIT
        t_end = hit.disc != NO_INDEX ? -1.0 : t_end;
#endif
        steps++;
    } while (walk.t < t_end && steps < kMostSteps);
#endif
    hit.t += t_start;
    return hit;
}
