// SPDX-License-Identifier: Apache-2.0
// Shading of first hits: blends the surface, adds what needs no light, asks for light and for the next ray.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_basic : require
#include "bindings.glsl"
#include "queue.glsl"
#include "splat.glsl"
#include "blend.glsl"
#include "camera_ray.glsl"
#include "room.glsl"
#include "offset.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

// A point of the scene as the integrators see it.
struct Point {
    float t; // negative: nothing is hit
    vec3 position;
    vec3 normal;
    vec3 albedo;        // linear
    vec3 mirror;        // linear reflectance of the mirror share
    float reflectivity; // share reflected as a mirror
    float specular;
    float shininess;
    float radius; // 0 on the room's walls
};

// Exact sRGB decoding is a power each; the cubic agrees within 0.002 (Chilliant 2012).
vec3 linearFromSrgb(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }

Point splatPoint(PathState path, uvec4 hit) {
    Surface surface =
        surfaceAt(path.origin.xyz, path.direction.xyz, hit);
    vec4 base = loadMaterial(surface.material, 0);
    vec4 gloss = loadMaterial(surface.material, 1);
    Point point;
    point.t = surface.t;
    point.position = path.origin.xyz + surface.t * path.direction.xyz;
    point.normal = surface.normal;
    point.albedo = base.rgb * linearFromSrgb(surface.color);
    point.mirror = vec3(1.0);
    point.reflectivity = hasOption(OPTION_OVERRIDE_REFLECTIVITY) ? params.splat.w : base.a;
    point.specular = params.mode.x == INTEGRATOR_PATH ? 0.0 : gloss.x; // Phong's highlight conserves no energy
    point.shininess = max(gloss.y, 1.0);
    point.radius = surface.radius;
    return point;
}

Point wallPoint(PathState path, float t, vec3 normal) {
    bool mirror = params.mode.z == ROOM_MIRROR;
    return Point(t, path.origin.xyz + t * path.direction.xyz, normal, kMatteWall, kMirrorWall, mirror ? 1.0 : 0.0, 0.0,
                 1.0, 0.0);
}

Point findPoint(PathState path, uvec4 hit) {
    Point point;
    point.t = -1.0;
    if (hit.z != NO_INDEX) point = splatPoint(path, hit);
    if (params.mode.z != ROOM_NONE) {
        vec3 normal;
        float t_wall = hitRoom(path.origin.xyz, path.direction.xyz, normal);
        if (point.t < 0.0 || t_wall < point.t) point = wallPoint(path, t_wall, normal);
    }
    return point;
}

uint appendSlot(bool wants, bool lit) {
    uvec4 ballot = subgroupBallot(wants);
    uint total = subgroupBallotBitCount(ballot);
    uint start = 0u;
    if (subgroupElect() && total > 0u) {
        if (lit) start = atomicAdd(control.queued.z, total);
        else start = hasStep(STEP_QUEUE_ONE) ? atomicAdd(control.queued.x, total) : atomicAdd(control.queued.y, total);
    }
    return subgroupBroadcastFirst(start) + subgroupBallotExclusiveBitCount(ballot);
}

void appendLit(bool wants, uint index, Point point, vec3 view, vec3 weight) {
    uint slot = appendSlot(wants, true);
    if (!wants) return;
    queues[litQueueStart() + slot] = index;
    float highlight = max(weight.x, max(weight.y, weight.z)) * point.specular;
    lit_points[index] = LitPoint(vec4(point.position, point.radius), vec4(point.normal, point.shininess),
                                 vec4(weight * point.albedo, highlight), vec4(view, 0.0));
}

void appendRay(bool wants, uint index, Point point, vec3 direction, vec3 throughput) {
    uint slot = appendSlot(wants, false);
    if (!wants) return;
    queues[rayQueueStart(!hasStep(STEP_QUEUE_ONE)) + slot] = index;
    float own_t;
    vec3 origin = leaveSurface(point.position, point.normal, point.radius, direction, own_t);
    vec3 left_normal = point.radius > 0.0 ? point.normal : vec3(0.0);
    paths[index] = PathState(vec4(origin, own_t), vec4(direction, 0.0), vec4(throughput, 0.0), vec4(left_normal, 0.0));
}

// Schlick's approximation for the 4% of common dielectrics: whitted's gloss on what phong shows matte.
float fresnel(float cosine) {
    float m = 1.0 - clamp(cosine, 0.0, 1.0);
    return 0.04 + 0.96 * m * m * m * m * m;
}

// Lambert's lobe about the normal.
vec3 cosineDirection(vec3 normal, vec2 u) {
    float angle = 6.28318530718 * u.x, ring = sqrt(u.y);
    vec3 helper = abs(normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 a = normalize(cross(normal, helper)), b = cross(normal, a);
    return normalize(ring * cos(angle) * a + ring * sin(angle) * b + sqrt(max(0.0, 1.0 - u.y)) * normal);
}

// What a point adds to the film, gives to its lights, and sends on.
struct Shading {
    vec3 added;        // radiance that needs no further ray
    vec3 matte_weight; // of the light that shadow rays may bring
    vec3 next;         // direction of the next ray
    vec3 next_weight;  // its throughput, 0 where there is none
};

// Nothing is hit: the sky.
Shading shadeSky(PathState path) {
    return Shading(path.throughput.rgb * skyColor(path.direction.xyz), vec3(0.0), vec3(0.0), vec3(0.0));
}

// Phong and Whitted: matte share, highlight and mirror share side by side; the mirror's ray is the one that goes on.
Shading shadeClassic(PathState path, Point point) {
    float mirror_share = point.reflectivity;
    if (params.mode.x == INTEGRATOR_WHITTED && point.specular > 0.0)
        mirror_share = max(mirror_share, fresnel(-dot(path.direction.xyz, point.normal)) * min(1.0, 4.0 * point.specular));
    vec3 matte_weight = path.throughput.rgb * (1.0 - mirror_share);
    return Shading(matte_weight * point.albedo * skyColor(point.normal) * AMBIENT_SHARE, matte_weight,
                   reflect(path.direction.xyz, point.normal), path.throughput.rgb * point.mirror * mirror_share);
}

// Path tracing: one of mirror and matte by chance; the chance and the share cancel.
Shading shadePath(PathState path, Point point, vec3 random) {
    if (random.z < point.reflectivity)
        return Shading(vec3(0.0), vec3(0.0), reflect(path.direction.xyz, point.normal), path.throughput.rgb * point.mirror);
    return Shading(vec3(0.0), path.throughput.rgb, cosineDirection(point.normal, random.xy),
                   path.throughput.rgb * point.albedo);
}

// The normal and depth views.
Shading shadeView(Point point) {
    vec3 color = vec3(0.0);
    if (point.t >= 0.0)
        color = params.mode.x == INTEGRATOR_NORMAL ? linearFromSrgb(point.normal * 0.5 + 0.5)
                                                   : vec3(max(0.0, 1.0 - point.t / params.sky_up.w));
    return Shading(color, vec3(0.0), vec3(0.0), vec3(0.0));
}

Shading shade(PathState path, Point point, uint pixel, uint bounce) {
    if (params.mode.x == INTEGRATOR_NORMAL || params.mode.x == INTEGRATOR_DEPTH) return shadeView(point);
    if (point.t < 0.0) return shadeSky(path);
    if (params.mode.x == INTEGRATOR_PATH) return shadePath(path, point, random3(pixel, push.step.x, bounce + 1u));
    return shadeClassic(path, point);
}

const uvec4 kNoHit = uvec4(0u, NO_INDEX, NO_INDEX, 0u);

// The camera ray of this lane's pixel; index is NO_INDEX where it has none.
PathState cameraPath(out uint index, out uvec4 hit) {
    uint lane = balancedLane(), tile = min(lane / TILE_PIXELS, bandTiles() - 1u);
    uvec2 pixel = tilePixel(tile, lane % TILE_PIXELS);
    index = lane < bandLanes() ? pixelIndex(pixel) : NO_INDEX;
    hit = index != NO_INDEX && loadBeam(tile) < BEAM_MISSES ? loadHit(index) : kNoHit;
    return PathState(vec4(params.eye.xyz, 0.0), vec4(cameraDirection(pixel), 0.0), vec4(1.0), vec4(0.0));
}

// The queued path of this lane; index is NO_INDEX where there is none.
PathState queuedPath(out uint index, out uvec4 hit) {
    index = queuedIndex(balancedLane());
    hit = index != NO_INDEX ? loadHit(index) : kNoHit;
    return paths[index != NO_INDEX ? index : 0u];
}

float largest(vec3 v) { return max(v.x, max(v.y, v.z)); }

// Rays weaker than a display's last step are not worth their cost.
const float kLeastWeight = 1.0 / 512.0;

void main() {
    uint bounce = push.step.z;
    uint index;
    uvec4 hit;
    PathState path = bounce == 0u ? cameraPath(index, hit) : queuedPath(index, hit);
    bool live = index != NO_INDEX;
    index = live ? index : 0u; // idle lanes work along: the appends below need the whole subgroup
    Point point = findPoint(path, hit);
    if (hasStep(STEP_FIRST_HIT)) {
        if (live) first_hits[index] = point.t < 0.0 ? vec4(0.0, 0.0, 0.0, -1.0) : vec4(point.normal, point.t);
        return;
    }
    Shading shading = shade(path, point, index + params.image.z * params.image.x, bounce);
    bool goes_on = live && largest(shading.next_weight) > kLeastWeight;
    if (goes_on && bounce >= params.mode.y) { // the last mirror shows the sky's ambient light instead of black
        if (params.mode.x != INTEGRATOR_PATH) shading.added += shading.next_weight * skyColor(shading.next) * AMBIENT_SHARE;
        goes_on = false;
    }
    float coverage = bounce == 0u && point.t >= 0.0 ? 1.0 : 0.0;
    vec4 before = bounce == 0u && push.step.x == 0u ? vec4(0.0) : film[index];
    if (live) film[index] = before + vec4(shading.added, coverage);
    appendLit(live && largest(shading.matte_weight) > 0.0, index, point, -path.direction.xyz, shading.matte_weight);
    appendRay(goes_on, index, point, shading.next, shading.next_weight);
}
