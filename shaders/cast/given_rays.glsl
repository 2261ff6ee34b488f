// SPDX-License-Identifier: Apache-2.0
// Rays and hits in the caller's layout: doubles or floats in world coordinates. The device converts a ray when it
// traces the ray, so the host at most copies rows of memory.
//
// Floats represent a ray precisely only from an origin close to what the ray may hit. So the origin is moved along the
// ray, in doubles, to the sphere around the cube. The distance to move is estimated in floats: any value will do as
// long as everything that follows uses the same one. Render space is the instance's cube.
#ifndef POINTRT_SHADERS_GIVEN_RAYS_GLSL
#define POINTRT_SHADERS_GIVEN_RAYS_GLSL
#include "shaders/cast/cast_bindings.glsl"
#include "shaders/shared/spec_constants.h"

// Whether the caller's numbers are doubles or floats.
layout(constant_id = SPEC_CAST_DOUBLES) const bool kDoubles = true;

layout(push_constant) uniform Push { GivenPush push; };

// GivenHit as two 64-bit words: on lavapipe, storing 32 bits takes as long. The host has filled the buffer with misses,
// so misses store nothing.
layout(std430, binding = BINDING_CAST_HITS) writeonly buffer Hits { double given_hits[]; };

uint rowOfLane(uint lane) { return lane; }

struct LoadedRay {
    CastRay ray;
    bool odd;       // the host must trace this ray: it is invalid, or has numbers too large or too small for floats
    double start;   // distance the origin was moved, in lengths of the given direction
    float per_unit; // lengths of the given direction per world unit
};

void loadDoubles(uint row, out dvec3 origin, out dvec3 direction) {
    int at = int(push.first_texel + 3u * row);
    uvec4 a = imageLoad(cast_ray_texels, at), b = imageLoad(cast_ray_texels, at + 1);
    uvec4 c = imageLoad(cast_ray_texels, at + 2);
    origin = dvec3(packDouble2x32(a.xy), packDouble2x32(a.zw), packDouble2x32(b.xy));
    direction = dvec3(packDouble2x32(b.zw), packDouble2x32(c.xy), packDouble2x32(c.zw));
}

// Two rays take three texels.
void loadFloats(uint row, out dvec3 origin, out dvec3 direction) {
    int at = int(push.first_texel + row + (row >> 1u));
    uvec4 a = imageLoad(cast_ray_texels, at), b = imageLoad(cast_ray_texels, at + 1);
    bool second = (row & 1u) != 0u;
    origin = dvec3(uintBitsToFloat(second ? uvec3(a.zw, b.x) : a.xyz));
    direction = dvec3(uintBitsToFloat(second ? b.yzw : uvec3(a.w, b.xy)));
}

LoadedRay loadRay(uint row) {
    dvec3 world, given;
    if (kDoubles)
        loadDoubles(row, world, given);
    else
        loadFloats(row, world, given);
    dvec3 origin = world - dvec3(push.origin_x, push.origin_y, push.origin_z);
    vec3 from = vec3(origin), along = vec3(given);
    float squared = dot(along, along), per_unit = 1.0 / sqrt(squared);
    bool odd = !(squared > GIVEN_LEAST && squared < GIVEN_MOST && dot(from, from) < GIVEN_MOST);
    vec3 direction = along * per_unit;
    // moves the origin to the sphere around the cube, which is wide enough for the rounding error of floats
    float ahead = (-dot(from, direction) - push.radius) * GIVEN_SHORT;
    double start = double(ahead > 0.0 ? ahead * per_unit : 0.0);
    start = start > push.t_min ? start : push.t_min;
    vec3 there = vec3(origin + start * given) * push.units + 0.5;
    float reach = float(push.t_max - start) * (squared * per_unit * push.units);
    reach = reach < CAST_FARTHEST ? reach : CAST_FARTHEST;
    return LoadedRay(CastRay(odd ? vec3(0.0) : there, odd ? -1.0 : reach, direction, 0.0), odd, start, per_unit);
}

// t: cube units; splat: NO_INDEX for a miss.
void storeHit(uint row, LoadedRay loaded, float t, uint splat, uint normal) {
    double given = loaded.start + double(t) * (double(loaded.per_unit) * push.scale);
    given = given < push.t_min ? push.t_min : given > push.t_max ? push.t_max : given;
    splat = loaded.odd ? CAST_ODD : splat;
    if (splat != NO_INDEX) {
        given_hits[2u * row] = given;
        given_hits[2u * row + 1u] = packDouble2x32(uvec2(splat, normal));
    }
}

void storeStopped(uint row, LoadedRay loaded, bool hits) {
    if (hits || loaded.odd) imageStore(cast_stopped, int(row), uvec4(loaded.odd ? CAST_ODD : 1u));
}

#endif
