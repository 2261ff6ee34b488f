// SPDX-License-Identifier: Apache-2.0
// Integrator ambient: the scan's colours without lamps. Next event estimation darkens them in hollows (ambient.glsl).
#ifndef POINTRT_SHADERS_SHADE_AMBIENT_GLSL
#define POINTRT_SHADERS_SHADE_AMBIENT_GLSL
#include "shaders/shade/sky.glsl"
#include "shaders/trace/surface_interaction.glsl"

// Brightness of a surface seen edge-on, relative to one that faces the eye.
const float kEdgeBrightness = 0.55;

Shading shadeAmbient(PathState path, SurfaceInteraction point, Material row, Bsdf bsdf, uint pixel) {
    if (point.t < 0.0) return onlyRadiance(path.throughput * skySeen(path));
    float facing = clamp(-dot(point.normal, path.direction), 0.0, 1.0);
    vec3 unoccluded = point.albedo * mix(kEdgeBrightness, 1.0, facing);
    if (isBackdrop(point)) unoccluded = params.sky_horizon; // floors blend into the sky
    return Shading(path.throughput * row.emission.rgb, path.throughput * unoccluded, noRay(), noRay());
}

#endif
