// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_BLEND_GLSL
#define POINTRT_SHADERS_BLEND_GLSL
#include "octree.glsl"

// A surface, not confetti: around the first hit, the splats of its cell blend position, normal and colour.
// Each disc carries a slab (blend_slab radii to either side). A splat's weight at a point is
// (1 - d^2/r^2)^2 (1 - h^2/s^2)^2 with d in the disc, h across it, s the slab's half height: zero with zero slope at
// the rim and at the slab's faces, so the blended field has no steps. A cell lists every splat whose slab meets it,
// so the field at a point is that of the cell that holds the point, and the same from either side of a border. The
// surface is where the weighted mean of the heights vanishes (Adamson and Alexa, Approximating and Intersecting
// Surfaces from Points, 2003); two Newton steps along the ray find it.

struct Surface {
    float t;      // along the ray
    vec3 normal;  // unit length, towards the ray's origin
    vec3 color;   // sRGB
    float radius; // weighted mean of the splats' radii
    uint material;
    uint splat; // hit first
    bool back;  // seen from behind, where normals tell
};

// Discs blend when their normals differ by less than 60 degrees; the sides of an edge or a thin sheet stay apart.
const float kSameSideCosine = 0.5;

// Below the least sum of weights that an even sampling leaves anywhere, 0.63 (kOverlap in the bake sees to that).
const float kWeightFloor = 0.5;

struct Field {
    float weight;
    float height; // weighted sums from here on
    vec3 normal;
    vec3 color;
    float radius;
    float heaviest; // largest weight so far, and whose material that is
    uint material;
};

// Adds one splat's share of the field at point. side is the first hit's normal towards the viewer, front the sign
// that turns stored normals the same way, or 0 where the file's normals are not oriented.
void addToField(inout Field field, uvec4 words, vec4 coding, vec3 point, vec3 side, float front) {
    vec3 normal = normalize(splatDirection(words));
    float cosine = dot(normal, side);
    float turn = front == 0.0 ? (cosine < 0.0 ? -1.0 : 1.0) : front;
    vec3 offset = point - splatPosition(words);
    float radius = splatRadius(words, coding);
    float height = dot(normal, offset);
    float in_plane = 1.0 - (dot(offset, offset) - height * height) / (radius * radius);
    float in_slab = 1.0 - height * height / (coding.z * coding.z * radius * radius);
    bool counts = turn * cosine > kSameSideCosine && in_plane > 0.0 && in_slab > 0.0;
    float weight = counts ? in_plane * in_plane * in_slab * in_slab : 0.0;
    field.weight += weight;
    field.height += weight * turn * height;
    field.normal += weight * turn * normal;
    field.color += weight * splatColor(words);
    field.radius += weight * radius;
    if (weight > field.heaviest) {
        field.heaviest = weight;
        field.material = splatMaterial(words);
    }
}

// What is missing to kWeightFloor is filled up by the disc hit first, whose plane goes on beyond its rim: where hardly
// anything else blends, at rims that stick out and at borders, the surface passes into the flat disc without a step.
void fillUp(inout Field field, uvec4 words, vec3 point, vec3 side) {
    float missing = max(kWeightFloor - field.weight, 0.0);
    field.weight += missing;
    field.height += missing * dot(side, point - splatPosition(words));
    field.normal += missing * side;
    field.color += missing * splatColor(words);
    field.radius += missing * splatRadius(words, instance.splat);
}

// The field at a point, around the disc hit first.
Field evaluateField(uint cell_index, uvec4 first, vec3 point, vec3 side, float front) {
    Field field = Field(0.0, 0.0, vec3(0.0), vec3(0.0), 0.0, 0.0, splatMaterial(first));
    uvec2 cell = loadCell(cell_index);
    uvec2 blending = loadBlendRange(cell_index);
    uint discs = cell[PRO_CELL_COUNT] & PRO_CELL_COUNT_MASK;
    uint count = discs + blending.y, k = 0u;
    vec4 coding = instance.splat;
    while (k < count) {
        uint listed = k < discs ? cell[PRO_CELL_FIRST] + k : blending.x + k - discs;
        addToField(field, loadSplat(loadListed(listed)), coding, point, side, front);
        k++;
    }
    fillUp(field, first, point, side);
    return field;
}

// The step along the ray to the field's zero, at most one radius: at grazing angles the field says little.
float newtonStep(Field field, vec3 direction, float radius) {
    float slope = dot(field.normal, direction);
    float step = slope == 0.0 ? 0.0 : -field.height / slope;
    return clamp(step, -radius, radius);
}

Surface flatSurface(SplatHit hit, vec3 direction) {
    vec3 normal = normalize(splatDirection(hit.words));
    bool back = dot(normal, direction) > 0.0;
    return Surface(hit.t, back ? -normal : normal, splatColor(hit.words), splatRadius(hit.words, instance.splat),
                   splatMaterial(hit.words), hit.splat, back && kOriented);
}

// At rims the blended normal may lean away from the viewer, who sees the surface all the same: it is brought back to
// this cosine, nearly at right angles.
const float kLeastFacing = 0.01;

vec3 bentToViewer(vec3 normal, vec3 direction) {
    float away = dot(normal, direction) + kLeastFacing;
    return away > 0.0 ? normalize(normal - away * direction) : normal;
}

// The surface at a traced hit, its words as stored, of the ray.
Surface surfaceAt(vec3 origin, vec3 direction, uvec4 hit) {
    SplatHit exact = exactHit(hit, origin, direction);
    uvec4 words = exact.words;
    float t = exact.t;
    Surface surface = flatSurface(exact, direction);
    if ((ofLane(params.scene.y) & OPTION_BLEND) == 0u) return surface;
    vec3 side = surface.normal;
    float front = kOriented ? (dot(side, splatDirection(words)) < 0.0 ? -1.0 : 1.0) : 0.0;
    float radius = surface.radius;

    vec3 point = origin + t * direction;
    uint cell = cellAt(point);
    cell = cell == NO_INDEX ? hit.y : cell; // the disc reaches into a cell that lists none
    Field field = evaluateField(cell, words, point, side, front);
    float t_blended = t + newtonStep(field, direction, radius);
    point = origin + t_blended * direction;
    uint second_cell = cellAt(point);
    field = evaluateField(second_cell == NO_INDEX ? cell : second_cell, words, point, side, front);
    t_blended += newtonStep(field, direction, radius);
    surface.t = clamp(t_blended, t - radius, t + radius);
    surface.normal = bentToViewer(normalize(field.normal), direction);
    surface.color = field.color / field.weight;
    surface.radius = field.radius / field.weight;
    surface.material = field.material;
    return surface;
}

#endif
