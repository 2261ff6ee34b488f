// SPDX-License-Identifier: Apache-2.0
// Light that mirrors and glass have bundled, gathered from photons around a point (Jensen, Global Illumination Using
// Photon Maps, 1996). The kernel is the weight that splats blend with: (1 - d^2/r^2)^2, over its integral pi r^2 / 3, so
// that a photon's light is spread around it and none is lost.
//
// The program defines loadPhoton(photon, member), a vec4 of it, and loadPhotonBucket(i), a word of the buckets.
#ifndef POINTRT_SHADERS_CAUSTIC_GLSL
#define POINTRT_SHADERS_CAUSTIC_GLSL
#include "photon_layout.h"

uint bucketOf(ivec3 cell, uint level) {
    uvec3 c = uvec3(cell);
    return (c.x * PHOTON_HASH_X ^ c.y * PHOTON_HASH_Y ^ c.z * PHOTON_HASH_Z ^ level * PHOTON_HASH_LEVEL) % PHOTON_BUCKETS;
}

// The grid of a level.
struct PhotonLevel {
    float number;
    float radius;
    float cells; // in a stage unit
    float scale; // inverse of the kernel's integral
};

PhotonLevel nextLevel(PhotonLevel level) {
    return PhotonLevel(level.number + 1.0, level.radius * PHOTON_LEVEL_RATIO, level.cells / PHOTON_LEVEL_RATIO,
                       level.scale / (PHOTON_LEVEL_RATIO * PHOTON_LEVEL_RATIO));
}

vec3 photonNormal(uint bits) {
    vec2 uv = unpackSnorm2x16(bits);
    vec3 n = vec3(uv, 1.0 - abs(uv.x) - abs(uv.y));
    float fold = max(-n.z, 0.0);
    n.xy -= vec2(n.x >= 0.0 ? fold : -fold, n.y >= 0.0 ? fold : -fold);
    return normalize(n);
}

// Surfaces that differ by more than 60 degrees are others, as for splats that blend.
const float kSameSurface = 0.5;

vec3 photonShare(uint photon, ivec3 cell, PhotonLevel level, vec3 position, vec3 normal) {
    vec4 place = loadPhoton(photon, 0), flux = loadPhoton(photon, 1);
    vec3 offset = position - place.xyz;
    float height = dot(normal, offset), distance = dot(offset, offset), squared = level.radius * level.radius;
    float inside = 1.0 - (distance - height * height) / squared;
    // buckets hold other cells' photons too, which come up with their own
    bool own = flux.w == level.number && ivec3(floor(place.xyz * level.cells)) == cell;
    bool counts = own && distance < squared &&
                  dot(normal, photonNormal(floatBitsToUint(place.w))) > kSameSurface;
    return counts ? flux.rgb * (inside * inside * level.scale) : vec3(0.0);
}

// Where a lane is among the cells around its point.
struct PhotonSearch {
    PhotonLevel level;
    ivec3 lowest; // of the level's 8 cells
    ivec3 cell;
    uint corner; // 0 to 7: next cell of the level
    uint photon;
    uint end;
};

PhotonSearch nextCell(PhotonSearch search, vec3 position) {
    bool up = search.corner == 8u;
    PhotonLevel above = nextLevel(search.level);
    if (up) search.level = above;
    search.lowest = ivec3(floor(position * search.level.cells - 0.5));
    search.corner = up ? 0u : search.corner;
    search.cell = search.lowest + ivec3(uvec3(search.corner, search.corner >> 1, search.corner >> 2) & 1u);
    uint bucket = bucketOf(search.cell, uint(search.level.number));
    search.photon = loadPhotonBucket(bucket);
    search.end = loadPhotonBucket(bucket + 1u);
    search.corner++;
    return search;
}

bool searches(PhotonSearch search) {
    return search.photon < search.end || search.corner < 8u || search.level.number < float(PHOTON_LEVELS - 1);
}

// Irradiance at a point whose unit normal is on the lit side.
vec3 causticIrradiance(CausticFrame map, vec3 position, vec3 normal) {
    vec4 kernel = map.kernel;
    PhotonSearch search =
        PhotonSearch(PhotonLevel(0.0, kernel.x, kernel.y, kernel.z), ivec3(0), ivec3(0), 0u, 0u, 0u);
    vec3 sum = vec3(0.0);
    do { // one loop over the photons of all cells, so that lanes do not wait for each other at each cell's end
        bool going = searches(search);
        PhotonSearch next = nextCell(search, position);
        if (going && search.photon >= search.end) search = next;
        bool has = going && search.photon < search.end;
        vec3 share = photonShare(has ? search.photon : 0u, search.cell, search.level, position, normal);
        sum += has ? share : vec3(0.0);
        search.photon += has ? 1u : 0u;
    } while (searches(search));
    return sum;
}

#endif
