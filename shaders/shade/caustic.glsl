// SPDX-License-Identifier: Apache-2.0
// Caustics: irradiance estimated from the photons around a point (Jensen, Global Illumination Using Photon Maps, 1996).
// The kernel is the blend weight of splats, (1 - d^2/r^2)^2, over its integral pi r^2 / 3, so that a photon's flux is
// conserved.
//
// The program defines loadPhoton(photon, member), a vec4 of a Photon, loadPhotonWord(i), a word of the buckets, and
// loadPhotonLevel(i).
#ifndef POINTRT_SHADERS_CAUSTIC_GLSL
#define POINTRT_SHADERS_CAUSTIC_GLSL
#include "shaders/shared/photon_layout.h"

uint photonBucket(ivec3 cell, uint level) {
    uvec3 c = uvec3(cell);
    return (c.x * PHOTON_HASH_X ^ c.y * PHOTON_HASH_Y ^ c.z * PHOTON_HASH_Z ^ level * PHOTON_HASH_LEVEL) % PHOTON_BUCKETS;
}

// Cosine of the largest angle between normals of one surface, 60 degrees as for splats that blend.
const float kSameSurface = 0.5;

// Kernel times the photon's flux, without 3 / (pi r^2). 0 for photons of other levels and out of reach, which may share
// the bucket.
vec3 photonShare(uint photon, float level, float squared_radius, vec3 position, vec3 normal) {
    vec4 place = loadPhoton(photon, 0), flux = loadPhoton(photon, 1);
    vec3 offset = position - place.xyz, facing = unpackSnorm4x8(floatBitsToUint(place.w)).xyz;
    float height = dot(facing, offset), squared_height = height * height, squared = dot(offset, offset);
    float inside = 1.0 - (squared - squared_height) / squared_radius;
    bool counts = flux.w == level && squared < squared_radius &&
                  squared_height < PHOTON_REACH * PHOTON_REACH * squared_radius && dot(normal, facing) > kSameSurface;
    return counts ? flux.rgb * (inside * inside) : vec3(0.0);
}

vec3 levelIrradiance(PhotonLevel level, uint number, bool live, vec3 position, vec3 normal) {
    bool reached = live && all(greaterThan(position, level.low.xyz)) && all(lessThan(position, level.high.xyz));
    uint bucket = photonBucket(ivec3(floor(position * level.low.w)), number);
    uint entry = reached ? loadPhotonWord(bucket) : 0u, end = reached ? loadPhotonWord(bucket + 1u) : 0u;
    float squared_radius = level.high.w * level.high.w;
    vec3 sum = vec3(0.0);
    while (entry < end) {
        sum += photonShare(loadPhotonWord(entry), float(number), squared_radius, position, normal);
        entry++;
    }
    return sum * (3.0 / (3.14159265358979 * squared_radius));
}

// Irradiance due to photons at a point whose unit normal is on the lit side; 0 if not live.
vec3 causticIrradiance(bool live, vec3 position, vec3 normal) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < PHOTON_LEVELS; i++) sum += levelIrradiance(loadPhotonLevel(i), i, live, position, normal);
    return sum;
}

#endif
