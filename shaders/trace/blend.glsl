// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_BLEND_GLSL
#define POINTRT_SHADERS_BLEND_GLSL
#include "format/base/blend_weight.h"
#include "shaders/trace/cell_list.glsl"
#include "shaders/trace/entry_grid.glsl"
#include "shaders/trace/splat.glsl"

// The blended surface: around the first hit, the splats of its cell blend position, normal and colour. Each disc has a
// slab (blend_slab radii to either side). A splat's weight at a point (format/base/blend_weight.h) is zero with zero
// slope at the rim and at the faces of the slab, so the blended field is smooth. A cell lists every splat whose slab
// overlaps it, so the field at a point can be evaluated from the cell that holds the point, and agrees on both sides of
// a border between cells. The surface is where the weighted mean of the heights vanishes (Adamson and Alexa,
// Approximating and Intersecting Surfaces from Points, 2003); two Newton steps along the ray find it.

// In cube units.
struct BlendedSurface {
    float t;      // along the ray
    vec3 normal;  // unit vector, facing the ray's origin
    vec3 color;   // sRGB
    float radius; // weighted mean of the splats' radii
    uint material;
    uint splat; // the splat hit
    bool back;  // seen from behind; false if the sides are not known
    bool sided; // the sides are known: normals are oriented, or the splat is a ball
    float noise; // standard deviation of the surface around that splat; 0 in clean scans
};

// Lengths in position codes.
struct Field {
    float weight;
    float height; // this and the next members are weighted sums
    vec3 normal;
    vec3 color;
    float radius;
    float heaviest; // largest weight so far, and the material of the splat that has it
    uint material;
};

// Where the field is evaluated. side: the normal of the first hit, facing the viewer; front: the sign that flips stored
// normals to that side, or 0 if the file's normals are not oriented.
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

// Which of two splats are valid and discs: balls do not blend.
bvec2 discsOf(uvec4 first, uvec4 second, bvec2 valid) {
    return bvec2(valid.x && !isBall(first), valid.y && !isBall(second));
}

// Weights of two splats. flip: the signs that flip their normals to side.
vec2 blendWeights(vec2 cosine, vec2 flip, vec2 in_plane, vec2 in_slab, bvec2 valid) {
    vec2 facing = flip * cosine;
    bool first = valid.x && BLEND_COUNTS(facing.x, in_plane.x, in_slab.x);
    bool second = valid.y && BLEND_COUNTS(facing.y, in_plane.y, in_slab.y);
    return mix(vec2(0.0), BLEND_WEIGHT(in_plane, in_slab), bvec2(first, second));
}

// Adds two splats to the field, each if valid. In pairs because, on CPUs, the latency of the chain of operations for
// one splat dominates; the operations for a second splat fill the gaps.
void addToField(inout Field field, uvec4 first, uvec4 second, bvec2 valid, vec4 coding, Probe probe) {
    VectorPair position = positionCodes(first, second), normal = normalCodes(first, second);
    VectorPair offset =
        VectorPair(probe.point.x - position.x, probe.point.y - position.y, probe.point.z - position.z);
    vec2 inverse_length = inversesqrt(dots(normal, normal));
    vec2 cosine = dots(normal, probe.side) * inverse_length;
    vec2 away = mix(vec2(1.0), vec2(-1.0), lessThan(cosine, vec2(0.0)));
    vec2 flip = probe.front == 0.0 ? away : vec2(probe.front);
    vec2 radius = vec2(splatRadius(first, coding), splatRadius(second, coding)), inverse = 1.0 / (radius * radius);
    vec2 height = dots(normal, offset) * inverse_length, squared = height * height;
    vec2 in_plane = 1.0 - (dots(offset, offset) - squared) * inverse, in_slab = 1.0 - squared * inverse * coding.z;
    if (kHasBalls) valid = discsOf(first, second, valid);
    vec2 weight = blendWeights(cosine, flip, in_plane, in_slab, valid), flipped = weight * flip;
    vec2 along = flipped * inverse_length;
    field.weight += weight.x + weight.y;
    field.height += dot(flipped, height);
    field.normal += vec3(dot(along, normal.x), dot(along, normal.y), dot(along, normal.z));
    field.color += weight.x * splatColor(first) + weight.y * splatColor(second);
    field.radius += dot(weight, radius);
    float heavier = max(weight.x, weight.y);
    bool heaviest = heavier > field.heaviest;
    field.material = heaviest ? splatMaterial(weight.y > weight.x ? second : first) : field.material;
    field.heaviest = heaviest ? heavier : field.heaviest;
}

// Raises the total weight to BLEND_WEIGHT_FLOOR with the disc hit first, extended as a plane beyond its rim. Where few
// other splats blend, as at protruding rims and at borders, the surface thus continues smoothly into the flat disc.
void addFloorWeight(inout Field field, uvec4 words, vec4 coding, Probe probe) {
    float missing = max(BLEND_WEIGHT_FLOOR - field.weight, 0.0);
    field.weight += missing;
    field.height += missing * dot(probe.side, probe.point - firstOf(positionCodes(words, words)));
    field.normal += missing * probe.side;
    field.color += missing * splatColor(words);
    field.radius += missing * splatRadius(words, coding);
}

// A loop over the discs of a cell and then the splats that only blend there, in pairs that start at an even index.
struct PairLoop {
    uint of_discs, all; // numbers of pairs
    uvec2 discs;        // the first near splat, and one past the last
    uvec2 others;       // indices of the splats that only blend, likewise
};

PairLoop pairsOf(uint cell_index) {
    uvec4 cell = loadCell(cell_index);
    uint first = cell[PRO_CELL_FIRST], first_other = cell[PRO_CELL_BLENDING];
    uvec2 discs = uvec2(first, first + (cell[PRO_CELL_COUNT] & PRO_CELL_COUNT_MASK));
    uvec2 others = uvec2(first_other, first_other + (cell[PRO_CELL_BLENDING_COUNT] & PRO_CELL_BLENDING_MASK));
    uint of_discs = (discs.y - (discs.x & ~1u) + 1u) / 2u;
    return PairLoop(of_discs, of_discs + (others.y - others.x + 1u) / 2u, discs, others);
}

// The splats of a pair; where valid is false, an arbitrary splat.
uvec2 splatsOf(PairLoop pairs, uint pair, out bvec2 valid) {
    bool is_disc = pair < pairs.of_discs;
    uint disc = (pairs.discs.x & ~1u) + 2u * (is_disc ? pair : 0u);
    uint other = pairs.others.x + 2u * (is_disc ? 0u : pair - pairs.of_discs);
    uvec2 blending = blendingPair(pairs.others.y > pairs.others.x ? other : 0u, pairs.discs.x);
    valid = is_disc ? bvec2(disc >= pairs.discs.x, disc + 1u < pairs.discs.y) : bvec2(true, other + 1u < pairs.others.y);
    return uvec2(loadListed(is_disc ? disc : blending.x), loadListed(is_disc ? disc + 1u : valid.y ? blending.y : 0u));
}

// The blended field at the probe. If not live, the field of the disc hit first alone.
Field evaluateField(uint cell_index, bool live, uvec4 first, Probe probe) {
    Field field = Field(0.0, 0.0, vec3(0.0), vec3(0.0), 0.0, 0.0, splatMaterial(first));
    PairLoop pairs = pairsOf(cell_index);
    vec4 coding = codingInCodes();
    uint pair = 0u, end = live ? pairs.all : 0u;
    // tested at the top: with a test at the end, some lanes would lose the result of their last iteration (trace.glsl)
    while (pair < end) {
        bvec2 valid;
        uvec2 splats = splatsOf(pairs, pair, valid);
        addToField(field, loadSplat(splats.x), loadSplat(splats.y), valid, coding, probe);
        pair++;
    }
    addFloorWeight(field, first, coding, probe);
    return field;
}

// Weighted sum of the normals of those splats of a pair that face the viewer.
vec3 frontsOfPair(uvec4 first, uvec4 second, bvec2 valid, vec4 coding, vec3 point, vec3 direction) {
    VectorPair position = positionCodes(first, second), normal = normalCodes(first, second);
    VectorPair offset = VectorPair(point.x - position.x, point.y - position.y, point.z - position.z);
    vec2 inverse_length = inversesqrt(dots(normal, normal));
    vec2 radius = vec2(splatRadius(first, coding), splatRadius(second, coding)), inverse = 1.0 / (radius * radius);
    vec2 height = dots(normal, offset) * inverse_length, squared = height * height;
    vec2 in_plane = 1.0 - (dots(offset, offset) - squared) * inverse, in_slab = 1.0 - squared * inverse * coding.z;
    bvec2 front = lessThan(dots(normal, direction), vec2(0.0));
    if (kHasBalls) valid = discsOf(first, second, valid);
    bool first_counts = valid.x && front.x && BLEND_IS_IN_REACH(in_plane.x, in_slab.x);
    bool second_counts = valid.y && front.y && BLEND_IS_IN_REACH(in_plane.y, in_slab.y);
    vec2 weight = mix(vec2(0.0), BLEND_WEIGHT(in_plane, in_slab), bvec2(first_counts, second_counts)) * inverse_length;
    return vec3(dot(weight, normal.x), dot(weight, normal.y), dot(weight, normal.z));
}

// Weighted sum of the normals of all splats that face the viewer and whose slabs hold the point; 0 if there are none,
// or if not live.
vec3 frontsAt(uint cell_index, bool live, vec3 point, vec3 direction) {
    PairLoop pairs = pairsOf(cell_index);
    vec4 coding = codingInCodes();
    vec3 sum = vec3(0.0);
    uint pair = 0u, end = live ? pairs.all : 0u;
    while (pair < end) {
        bvec2 valid;
        uvec2 splats = splatsOf(pairs, pair, valid);
        sum += frontsOfPair(loadSplat(splats.x), loadSplat(splats.y), valid, coding, point, direction);
        pair++;
    }
    return sum;
}

// Newton step along the ray to the zero of the field, at most one radius: at grazing angles the slope is unreliable.
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
                          splatMaterial(words), splat, back && kOriented, kOriented, noise);
}

// At rims the blended normal may face away from the viewer although the surface is visible. It is then bent back until
// it is nearly perpendicular to the ray, with this cosine.
const float kMinFacing = 0.01;

vec3 bentToViewer(vec3 normal, vec3 direction) {
    float away = dot(normal, direction) + kMinFacing;
    return away > 0.0 ? normalize(normal - away * direction) : normal;
}

// Radius to offset rays by (shaders/trace/offset.glsl) relative to the radius of a ball. A ball's surface is exact, and
// a higher lift would often start rays inside a neighbouring ball: the lift of 1/32 radius is about how far the
// quantized ball (pointrt/pro_index_layout.h) extends. Rays are clear of the quantized ball within half a radius.
const float kBallOffset = 1.0 / 8.0;

BlendedSurface ballSurface(uint splat, uvec4 words, float t, vec3 origin, vec3 direction) {
    float radius = splatRadius(words, instance.splat);
    vec3 center = splatPosition(words), start = origin - center, normal = normalize(origin + t * direction - center);
    bool back = kClipped ? dot(normal, direction) > 0.0 : dot(start, start) < radius * radius;
    normal = bentToViewer(back ? -normal : normal, direction); // rays that graze the quantized ball may miss this one
    return BlendedSurface(t, normal, splatColor(words), kBallOffset * radius, splatMaterial(words), splat, back, true,
                          0.0);
}

// Whether the hits of a path with these bits are visible in the picture, directly or through mirrors and glass. After
// diffuse scattering, blended and flat surfaces look alike (tests/bench/NOTES.md, Hits after diffuse scattering).
bool isSeen(uint bits) { return (bits & PATH_DIFFUSED) == 0u; }

// The surface at a traced hit of the ray (the words as stored). blends: false gives the flat disc, with the side chosen
// as below. Balls are spheres in any case.
//
// A back that a front covers is not a surface. Where a body curves away from the viewer, the discs beyond its
// silhouette protrude, and rays that pass the rims of the front discs hit the protruding ones from behind, in the dark.
// Such a hit is treated as the rim of the front disc whose slab holds it, and takes that disc's side. Hits within the
// self-intersection distance self_t stay unchanged: from inside a body, or in a hollow, rays hit backs at grazing
// angles next to fronts of the same surface.
BlendedSurface surfaceAt(vec3 origin, vec3 direction, float self_t, uvec4 hit, bool blends) {
    uint splat = loadListed(hit.z);
    uvec4 words = loadSplat(splat);
    float t = exactDistance(hit, words, origin, direction);
    if (isBall(words)) return ballSurface(splat, words, t, origin, direction);
    BlendedSurface surface = flatSurface(splat, words, t, direction);
    if ((ofLane(params.options) & OPTION_BLEND) == 0u) return surface;
    vec3 side = surface.normal;
    float front = kOriented ? (dot(side, splatDirection(words)) < 0.0 ? -1.0 : 1.0) : 0.0;
    float radius = surface.radius;

    vec3 point = origin + t * direction;
    uint cell = cellAt(point);
    cell = cell == NO_INDEX ? hit.y : cell; // the disc extends into an empty cell
    if (kOriented) {
        vec3 fronts = frontsAt(cell, surface.back && t > self_t, codesOf(point), direction);
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
