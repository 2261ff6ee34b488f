// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_BLEND_GLSL
#define POINTRT_SHADERS_BLEND_GLSL
#include "format/base/blend_weight.h"
#include "shaders/trace/cell_list.glsl"
#include "shaders/trace/entry_grid.glsl"
#include "shaders/trace/splat.glsl"

// A surface, not confetti: around the first hit, the splats of its cell blend position, normal and colour.
// Each disc carries a slab (blend_slab radii to either side). A splat's weight at a point (format/base/blend_weight.h)
// is zero with zero slope at the rim and at the slab's faces, so the blended field has no steps. A cell lists every
// splat whose slab meets it, so the field at a point is that of the cell that holds the point, and the same from either
// side of a border. The surface is where the weighted mean of the heights vanishes (Adamson and Alexa, Approximating and Intersecting
// Surfaces from Points, 2003); two Newton steps along the ray find it.

// In the instance's cube.
struct BlendedSurface {
    float t;      // along the ray
    vec3 normal;  // unit length, towards the ray's origin
    vec3 color;   // sRGB
    float radius; // weighted mean of the splats' radii
    uint material;
    uint splat; // hit first
    bool back;  // seen from behind, where normals tell
    float noise; // standard deviation of the surface around that splat; 0 in clean scans
};

// Lengths in position codes.
struct Field {
    float weight;
    float height; // weighted sums from here on
    vec3 normal;
    vec3 color;
    float radius;
    float heaviest; // largest weight so far, and whose material that is
    uint material;
};

// Where the field is asked for. side is the first hit's normal towards the viewer, front the sign that turns stored
// normals the same way, or 0 where the file's normals are not oriented.
struct Probe {
    vec3 point; // in position codes
    vec3 side;
    float front;
};

vec3 codesOf(vec3 point) { return point * PRO_POSITION_STEPS - 0.5; }

// instance.splat with lengths in position codes, z: inverse square of blend_slab.
vec4 codingInCodes() {
    vec4 coding = instance.splat;
    return vec4(coding.x * PRO_POSITION_STEPS, coding.y, 1.0 / (coding.z * coding.z), coding.w);
}

// Weights of two splats. turn: the signs that turn their normals to side.
vec2 blendWeights(vec2 cosine, vec2 turn, vec2 in_plane, vec2 in_slab, bvec2 there) {
    vec2 facing = turn * cosine;
    bool first = there.x && BLEND_COUNTS(facing.x, in_plane.x, in_slab.x);
    bool second = there.y && BLEND_COUNTS(facing.y, in_plane.y, in_slab.y);
    return mix(vec2(0.0), BLEND_WEIGHT(in_plane, in_slab), bvec2(first, second));
}

// Adds the shares of two splats, where they are there. Two, because on processors a splat's share takes its chain of
// operations, not their number: the other's fit in between.
void addToField(inout Field field, uvec4 first, uvec4 second, bvec2 there, vec4 coding, Probe probe) {
    VectorPair position = positionCodes(first, second), normal = normalCodes(first, second);
    VectorPair offset =
        VectorPair(probe.point.x - position.x, probe.point.y - position.y, probe.point.z - position.z);
    vec2 inverse_length = inversesqrt(dots(normal, normal));
    vec2 cosine = dots(normal, probe.side) * inverse_length;
    vec2 away = mix(vec2(1.0), vec2(-1.0), lessThan(cosine, vec2(0.0)));
    vec2 turn = probe.front == 0.0 ? away : vec2(probe.front);
    vec2 radius = vec2(splatRadius(first, coding), splatRadius(second, coding)), inverse = 1.0 / (radius * radius);
    vec2 height = dots(normal, offset) * inverse_length, squared = height * height;
    vec2 in_plane = 1.0 - (dots(offset, offset) - squared) * inverse, in_slab = 1.0 - squared * inverse * coding.z;
    vec2 weight = blendWeights(cosine, turn, in_plane, in_slab, there), turned = weight * turn;
    vec2 along = turned * inverse_length;
    field.weight += weight.x + weight.y;
    field.height += dot(turned, height);
    field.normal += vec3(dot(along, normal.x), dot(along, normal.y), dot(along, normal.z));
    field.color += weight.x * splatColor(first) + weight.y * splatColor(second);
    field.radius += dot(weight, radius);
    float heavier = max(weight.x, weight.y);
    bool heaviest = heavier > field.heaviest;
    field.material = heaviest ? splatMaterial(weight.y > weight.x ? second : first) : field.material;
    field.heaviest = heaviest ? heavier : field.heaviest;
}

// What is missing to BLEND_WEIGHT_FLOOR is filled up by the disc hit first, whose plane goes on beyond its rim: where hardly
// anything else blends, at rims that stick out and at borders, the surface passes into the flat disc without a step.
void fillUp(inout Field field, uvec4 words, vec4 coding, Probe probe) {
    float missing = max(BLEND_WEIGHT_FLOOR - field.weight, 0.0);
    field.weight += missing;
    field.height += missing * dot(probe.side, probe.point - firstOf(positionCodes(words, words)));
    field.normal += missing * probe.side;
    field.color += missing * splatColor(words);
    field.radius += missing * splatRadius(words, coding);
}

// A loop over a cell's discs and then those that only blend there, two a turn, from an even one on.
struct Turns {
    uint of_discs, all;
    uvec2 discs;  // the first near splat, and the one behind the last
    uvec2 others; // numbers of what only blends, likewise
};

Turns turnsOf(uint cell_index) {
    uvec4 cell = loadCell(cell_index);
    uint first = cell[PRO_CELL_FIRST], first_other = cell[PRO_CELL_BLENDING];
    uvec2 discs = uvec2(first, first + (cell[PRO_CELL_COUNT] & PRO_CELL_COUNT_MASK));
    uvec2 others = uvec2(first_other, first_other + (cell[PRO_CELL_BLENDING_COUNT] & PRO_CELL_BLENDING_MASK));
    uint of_discs = (discs.y - (discs.x & ~1u) + 1u) / 2u;
    return Turns(of_discs, of_discs + (others.y - others.x + 1u) / 2u, discs, others);
}

// The splats of a turn, any where there is none.
uvec2 splatsOf(Turns turns, uint turn, out bvec2 there) {
    bool is_disc = turn < turns.of_discs;
    uint disc = (turns.discs.x & ~1u) + 2u * (is_disc ? turn : 0u);
    uint other = turns.others.x + 2u * (is_disc ? 0u : turn - turns.of_discs);
    uvec2 blending = blendingPair(turns.others.y > turns.others.x ? other : 0u, turns.discs.x);
    there = is_disc ? bvec2(disc >= turns.discs.x, disc + 1u < turns.discs.y) : bvec2(true, other + 1u < turns.others.y);
    return uvec2(loadListed(is_disc ? disc : blending.x), loadListed(is_disc ? disc + 1u : there.y ? blending.y : 0u));
}

// The field around the disc hit first. asks: whether this lane wants to know; else it is that disc's alone.
Field evaluateField(uint cell_index, bool asks, uvec4 first, Probe probe) {
    Field field = Field(0.0, 0.0, vec3(0.0), vec3(0.0), 0.0, 0.0, splatMaterial(first));
    Turns turns = turnsOf(cell_index);
    vec4 coding = codingInCodes();
    uint turn = 0u, end = asks ? turns.all : 0u;
    // asked at its top: at its end some lanes would lose what their last turn added (trace.glsl)
    while (turn < end) {
        bvec2 there;
        uvec2 splats = splatsOf(turns, turn, there);
        addToField(field, loadSplat(splats.x), loadSplat(splats.y), there, coding, probe);
        turn++;
    }
    fillUp(field, first, coding, probe);
    return field;
}

// The normals of a turn's splats that face the viewer, by their weights at the point.
vec3 frontsOfTurn(uvec4 first, uvec4 second, bvec2 there, vec4 coding, vec3 point, vec3 direction) {
    VectorPair position = positionCodes(first, second), normal = normalCodes(first, second);
    VectorPair offset = VectorPair(point.x - position.x, point.y - position.y, point.z - position.z);
    vec2 inverse_length = inversesqrt(dots(normal, normal));
    vec2 radius = vec2(splatRadius(first, coding), splatRadius(second, coding)), inverse = 1.0 / (radius * radius);
    vec2 height = dots(normal, offset) * inverse_length, squared = height * height;
    vec2 in_plane = 1.0 - (dots(offset, offset) - squared) * inverse, in_slab = 1.0 - squared * inverse * coding.z;
    bvec2 front = lessThan(dots(normal, direction), vec2(0.0));
    bool first_counts = there.x && front.x && BLEND_IS_IN_REACH(in_plane.x, in_slab.x);
    bool second_counts = there.y && front.y && BLEND_IS_IN_REACH(in_plane.y, in_slab.y);
    vec2 weight = mix(vec2(0.0), BLEND_WEIGHT(in_plane, in_slab), bvec2(first_counts, second_counts)) * inverse_length;
    return vec3(dot(weight, normal.x), dot(weight, normal.y), dot(weight, normal.z));
}

// The sum of the normals of those that face the viewer and whose slabs hold the point; 0 where there are none. asks:
// whether this lane wants to know.
vec3 frontsAt(uint cell_index, bool asks, vec3 point, vec3 direction) {
    Turns turns = turnsOf(cell_index);
    vec4 coding = codingInCodes();
    vec3 sum = vec3(0.0);
    uint turn = 0u, end = asks ? turns.all : 0u;
    while (turn < end) {
        bvec2 there;
        uvec2 splats = splatsOf(turns, turn, there);
        sum += frontsOfTurn(loadSplat(splats.x), loadSplat(splats.y), there, coding, point, direction);
        turn++;
    }
    return sum;
}

// The step along the ray to the field's zero, at most one radius: at grazing angles the field says little.
float newtonStep(Field field, vec3 direction, float radius) {
    float slope = dot(field.normal, direction);
    float step = slope == 0.0 ? 0.0 : -field.height * PRO_POSITION_STEP / slope;
    return clamp(step, -radius, radius);
}

BlendedSurface flatSurface(uint splat, uvec4 words, float t, vec3 direction) {
    vec3 normal = normalize(splatDirection(words));
    bool back = dot(normal, direction) > 0.0;
    float radius = splatRadius(words, instance.splat);
    float noise = kNoisy ? radius * float(loadNoise(splat)) / PRO_NOISE_STEPS : 0.0;
    return BlendedSurface(t, back ? -normal : normal, splatColor(words), radius,
                          splatMaterial(words), splat, back && kOriented, noise);
}

// At rims the blended normal may lean away from the viewer, who sees the surface all the same: it is brought back to
// this cosine, nearly at right angles.
const float kMinFacing = 0.01;

vec3 bentToViewer(vec3 normal, vec3 direction) {
    float away = dot(normal, direction) + kMinFacing;
    return away > 0.0 ? normalize(normal - away * direction) : normal;
}

// Whether the picture shows what a path with these bits meets, by mirrors and glass at most. What scattered light has met
// no eye tells from the discs that are there (NOTES.md, Frames).
bool isSeen(uint bits) { return (bits & PATH_DIFFUSED) == 0u; }

// The surface at a traced hit, its words as stored, of the ray. blends: whether anybody can see how smooth it is; else it
// is the disc, with the side that is told below.
//
// A back that a front covers is no surface. Where a body turns away from the viewer, the discs beyond its outline stick
// out over it, and rays that pass the front ones by their rims meet those from behind, where no light is. Such a hit is
// the rim of the front whose slab holds it, and has its side. Hits nearer than own_t of the surface that the ray left are
// what they are: from within a body, or a hollow, rays meet backs at grazing angles beside fronts of that surface.
BlendedSurface surfaceAt(vec3 origin, vec3 direction, float own_t, uvec4 hit, bool blends) {
    uint splat = loadListed(hit.z);
    uvec4 words = loadSplat(splat);
    float t = exactDistance(hit, words, origin, direction);
    BlendedSurface surface = flatSurface(splat, words, t, direction);
    if ((ofLane(params.options) & OPTION_BLEND) == 0u) return surface;
    vec3 side = surface.normal;
    float front = kOriented ? (dot(side, splatDirection(words)) < 0.0 ? -1.0 : 1.0) : 0.0;
    float radius = surface.radius;

    vec3 point = origin + t * direction;
    uint cell = cellAt(point);
    cell = cell == NO_INDEX ? hit.y : cell; // the disc reaches into a cell that lists none
    if (kOriented) {
        vec3 fronts = frontsAt(cell, surface.back && t > own_t, codesOf(point), direction);
        bool covered = dot(fronts, fronts) > 0.0;
        side = covered ? normalize(fronts) : side;
        front = covered ? 1.0 : front;
        surface.back = surface.back && !covered;
    }
    Field field = evaluateField(cell, blends, words, Probe(codesOf(point), side, front));
    float t_blended = t + newtonStep(field, direction, radius);
    point = origin + t_blended * direction;
    uint second_cell = cellAt(point);
    field = evaluateField(second_cell == NO_INDEX ? cell : second_cell, blends, words, Probe(codesOf(point), side, front));
    t_blended += newtonStep(field, direction, radius);
    surface.t = blends ? clamp(t_blended, t - radius, t + radius) : t;
    surface.normal = bentToViewer(normalize(field.normal), direction);
    surface.color = field.color / field.weight;
    surface.radius = field.radius * PRO_POSITION_STEP / field.weight;
    surface.material = field.material;
    return surface;
}

#endif
