// SPDX-License-Identifier: Apache-2.0
// Beam tracing: the distance that all camera rays of a tile of pixels can skip. One lane per tile marches a beam, which
// contains the tile's rays, through the entry grid: a cone, or a prism with parallel projection. Tiles whose beam
// leaves the grid are done; the others are queued for intersect_camera. For tiles of a set in a block, there is a lane
// for each of these and each tile of pixels.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#include "shaders/lib/bindings.glsl"
#include "shaders/trace/entry_grid.glsl"
#include "shaders/lib/camera_ray.glsl"
#include "shaders/trace/instance.glsl"
#include "shaders/lib/math.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

float least(vec3 v) { return min(v.x, min(v.y, v.z)); }

// Half the edge, in cells, of the empty cube around an empty cell, the cell included: its smallest skip.
float freeCells(uint word) {
    uvec4 low = uvec4(word, word >> 4, word >> 8, word >> 12) & PRO_SKIP_MASK;
    uvec4 high = uvec4(word >> 16, word >> 20, word >> 24, word >> 28) & PRO_SKIP_MASK;
    uvec4 both = min(low, high);
    return skippedCells(min(min(both.x, both.y), min(both.z, both.w)), 0u);
}

// Lower bound of the Chebyshev distance, in grid units, from a point to any filled cell of a box. From a point outside
// the box, filled cells are at least as far as the box, and at least as far as from the nearest point of the box.
float freeAround(vec3 point, Grid grid, vec3 lowest, vec3 highest) {
    float outside = largest(max(lowest - point, point - highest));
    point = clamp(point, lowest, highest);
    vec3 base = min(floor(point), gridEnd() - 1.0);
    uint word = gridWord(ivec3(base), grid);
    vec3 in_cell = point - base;
    float inside = isFilled(word) ? 0.0 : freeCells(word) - 1.0 + least(min(in_cell, 1.0 - in_cell));
    return max(outside, inside);
}

// Shortest step worth its cost, in cells.
const float kMinStep = 0.25;
// Limit of steps, for beams that creep along a surface. The distance reached by then is safe.
const int kMaxSteps = 96;

// A bundle of rays around a centre ray, in cube units: origins within width of its origin, directions within spread of
// its direction.
struct Beam {
    CameraRay center;
    float width;
    float spread;
};

// Bound of the rounding error, relative to the distance from the eye: a few times 2^-24.
const float kStartRounding = 1e-6;

// The spread in radians. For angles d and e between two latitudes and two longitudes, the directions are at most
// sqrt(d^2 + cos cos e^2) apart, with the cosines of both latitudes.
Beam panoramaBeam(vec2 middle) {
    vec2 angles = panoramaAngles(middle), size = vec2(params.picture_width, params.picture_height);
    vec2 reach = 0.5 * TILE_SIDE * kPi * vec2(2.0, kIsStereo ? 2.0 : 1.0) / size;
    float cosine = abs(cos(angles.y)), spread = length(reach * vec2(sqrt(cosine * min(1.0, cosine + reach.y)), 1.0));
    // the eyes move along their circle, and towards its middle as the cosine of the latitude changes
    float width = params.half_eye_distance * (reach.x + reach.y / PANORAMA_FULL_STEREO_COSINE);
    // the tile may have rows of both eyes
    float to_other_eye = abs(middle.y - 0.5 * size.y);
    if (kIsStereo && to_other_eye < 0.5 * TILE_SIDE) width = 2.0 * params.half_eye_distance, spread = 2.0;
    CameraRay ray = panoramaRay(middle);
    return Beam(CameraRay(cubePoint(ray.origin), cubeDirection(ray.direction)), width * cubeScale(), spread);
}

Beam tileBeam(vec2 corner) {
    vec2 middle = corner + 0.5 * TILE_SIDE;
    if (kIsPanorama) return panoramaBeam(middle);
    CameraRay ray = rayThrough(middle);
    vec2 start = onPlane(middle, params.half_window);
    float width = distance(onPlane(corner, params.half_window), start) + kStartRounding * length(start);
    // normalizing vectors of length 1 or more never moves them apart: directions differ by no more than the points on
    // the plane
    float spread = distance(onPlane(corner, params.tan_half_fov), onPlane(middle, params.tan_half_fov));
    return Beam(CameraRay(cubePoint(ray.origin), cubeDirection(ray.direction)), width * cubeScale(), spread);
}

// The distance, in cube units, that all rays of a beam can skip; BEAM_MISSES if they leave the grid.
float marchBeam(Beam beam) {
    Grid grid = loadGridFrame();
    float scale = instance.grid_scale.x;
    vec3 start = gridPoint(beam.center.origin), direction = beam.center.direction, lowest, highest;
    traversedBox(start, lowest, highest);
    float width = beam.width * scale;
    // beyond the farthest corner no ray is in the grid
    float t_far = length(max(abs(lowest - start), abs(highest - start)));
    float t = 0.0, advance = kMinStep;
    int left = kMaxSteps;
    do { // finished lanes take part until all have finished: see trace.glsl
        bool going = advance >= kMinStep && t < t_far && left > 0;
        float free = freeAround(start + direction * t, grid, lowest, highest);
        float further = (free - width - t * beam.spread) / (largest(abs(direction)) + beam.spread);
        advance = going ? further : advance;
        t = going ? t + max(further, 0.0) : t;
        left--;
    } while (advance >= kMinStep && t < t_far && left > 0);
    // minus the rounding error
    return t < t_far ? max(0.0, t * (1.0 - 1e-6) / scale - 2.0 * PRO_POSITION_STEP) : BEAM_MISSES;
}

// The distance that all rays of a tile of pixels travel without a hit.
float freeDistance(uint tile) {
    // the beam covers the picture's whole tile, even if the band has only some of its rows, so that distances do not
    // depend on the bands
    float rows_above = float(params.first_row % TILE_SIDE);
    float safe = marchBeam(tileBeam(pixelCorner(tileCorner(tile)) - vec2(0.0, rows_above)));
    return hasStep(STEP_PIXEL_LIST) ? 0.0 : safe; // pixels of a list are not neighbours
}

// All lanes of the subgroup must call it.
void queueTile(bool queues_it, uint tile) {
    uvec4 ballot = subgroupBallot(queues_it);
    uint count = subgroupBallotBitCount(ballot), start = 0u;
    if (subgroupElect() && count > 0u) {
        start = atomicAdd(control.tile_count, count);
        atomicMax(control.tile_groups.x, ((start + count) * TILE_PIXELS + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE);
    }
    start = subgroupBroadcastFirst(start);
    if (queues_it) queues[start + subgroupBallotExclusiveBitCount(ballot)] = tile;
}

#ifdef POOLED
#include "shaders/trace/pool_beam.glsl"

// The masks of this workgroup's tiles of pixels, at most one per lane.
shared uint masks[WORKGROUP_SIZE];

void main() {
    masks[gl_LocalInvocationID.x] = 0u;
    barrier();
    uint tile = gl_GlobalInvocationID.x / kCullBoxes, place = gl_GlobalInvocationID.x % kCullBoxes;
    uint in_group = gl_LocalInvocationID.x / kCullBoxes;
    bool in_band = tile < bandTiles(), live = in_band && (cull.instances.x >> place & 1u) != 0u;
    selectTile(live ? place : 0u);
    float safe = freeDistance(in_band ? tile : 0u);
    if (live) beams[beamPlace(tile, place)] = safe;
    if (live && safe < BEAM_MISSES) atomicOr(masks[in_group], 1u << place);
    barrier();
    uint mask = masks[in_group];
    bool is_first = place == 0u && in_band && mask != 0u;
    if (is_first) queues[beamMaskPlace(tile)] = mask;
    queueTile(is_first, tile);
}
#else
void main() {
    uint tile = gl_GlobalInvocationID.x;
    bool live = tile < bandTiles();
    float safe = freeDistance(tile);
    if (live) beams[tile] = safe;
    queueTile(live && safe < BEAM_MISSES, tile);
}
#endif
