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
#include "random.glsl"
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
        surfaceAt(path.origin.xyz, path.direction.xyz, uintBitsToFloat(hit.x), hit.y, hit.z);
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

void recordFirstHit(uint index, Point point) {
    first_hits[index] = point.t < 0.0 ? vec4(0.0, 0.0, 0.0, -1.0) : vec4(point.normal, point.t);
}

vec3 debugColor(Point point) {
    if (point.t < 0.0) return vec3(0.0);
    if (params.mode.x == INTEGRATOR_NORMAL) return linearFromSrgb(point.normal * 0.5 + 0.5);
    return vec3(max(0.0, 1.0 - point.t / params.sky_up.w));
}

void main() {
    uint index = queuedPath(balancedLane());
    bool live = index != NO_INDEX;
    uint path_index = live ? index : 0u;
    PathState path = paths[path_index];
    uvec4 hit = live ? hits[path_index] : uvec4(0u, NO_INDEX, NO_INDEX, 0u);
    Point point = findPoint(path, hit);
    uint bounce = push.step.z & 0xFFFFu;
    bool on_surface = live && point.t >= 0.0;

    if (hasStep(STEP_FIRST_HIT)) {
        if (live) recordFirstHit(path_index, point);
        return;
    }
    bool debug = params.mode.x == INTEGRATOR_NORMAL || params.mode.x == INTEGRATOR_DEPTH;
    vec3 direction = path.direction.xyz, throughput = path.throughput.rgb;
    vec3 added = vec3(0.0);
    float coverage = bounce == 0u && (on_surface || params.mode.z != ROOM_NONE) ? 1.0 : 0.0;
    if (debug) added = debugColor(point);
    else if (!on_surface) added = throughput * skyColor(direction);

    bool tracing_paths = params.mode.x == INTEGRATOR_PATH;
    float cosine = on_surface ? -dot(direction, point.normal) : 1.0;
    float mirror_share = on_surface ? point.reflectivity : 0.0;
    vec3 mirror_color = on_surface ? point.mirror : vec3(1.0);
    if (params.mode.x == INTEGRATOR_WHITTED && on_surface && point.specular > 0.0 && point.radius > 0.0)
        mirror_share = max(mirror_share, fresnel(cosine) * min(1.0, 4.0 * point.specular));
    vec3 random = random3(index + params.image.z * params.image.x, push.step.x, bounce + 1u);
    // one ray leaves each point: paths choose between mirror and matte, the others reflect and light both shares
    bool choose_mirror = !tracing_paths || random.z < mirror_share;
    vec3 matte_weight = throughput * (tracing_paths ? (choose_mirror ? 0.0 : 1.0) : 1.0 - mirror_share);
    vec3 next = choose_mirror ? reflect(direction, on_surface ? point.normal : vec3(0.0)) : cosineDirection(point.normal, random.xy);
    vec3 next_weight = throughput * (tracing_paths ? (choose_mirror ? mirror_color : point.albedo) : mirror_color * mirror_share);

    bool shaded = on_surface && !debug;
    if (shaded && !tracing_paths) added += matte_weight * point.albedo * skyColor(point.normal) * AMBIENT_SHARE;
    // reflections weaker than a display's last step are not worth a ray
    bool goes_on = shaded && max(next_weight.x, max(next_weight.y, next_weight.z)) > 1.0 / 512.0;
    if (goes_on && bounce >= params.mode.y) {
        if (!tracing_paths) added += next_weight * skyColor(next) * AMBIENT_SHARE;
        goes_on = false;
    }
    bool wants_light = shaded && max(matte_weight.x, max(matte_weight.y, matte_weight.z)) > 0.0;
    if (live) film[path_index] += vec4(added, coverage);
    appendLit(wants_light, path_index, point, -direction, matte_weight);
    appendRay(goes_on, path_index, point, next, next_weight);
}
