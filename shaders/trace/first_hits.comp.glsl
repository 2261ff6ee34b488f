// SPDX-License-Identifier: Apache-2.0
// Stores the first hits of the rays through pixel centres: depth, normal and ids (AOVs).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/trace/surface_interaction.glsl"
#include "shaders/shared/film_parts.h"

// How strongly the look of the surface depends on the view direction: 0 to 1.
float viewDependence(Material row) {
    int kind = materialKind(row);
    if (kind == MATERIAL_MIRROR || kind == MATERIAL_GLASS) return 1.0;
    return max(mirrorShare(row), kind == MATERIAL_METAL ? 1.0 - roughness(row) : 0.0);
}

void main() {
    uint index;
    PathState path = currentPath(index);
    if (index == NO_INDEX) return;
    SurfaceInteraction point = findInteraction(index, path, loadHit(index));
    bool hit = point.t >= 0.0;
    uint at = FIRST_HIT_VECTORS * (params.film_first + bandPixel(index));
    first_hits[at] = hit ? vec4(point.normal, point.t) : vec4(0.0, 0.0, 0.0, -1.0);
    uvec3 ids = hit ? uvec3(point.primitive, point.owner | point.tile << HIT_TILE_SHIFT, materialOf(point)) : uvec3(NO_INDEX);
    first_hits[at + 1u] = vec4(uintBitsToFloat(ids), hit ? viewDependence(loadMaterial(ids.z)) : 0.0);
}
