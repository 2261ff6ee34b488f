// SPDX-License-Identifier: Apache-2.0
// Integrators normal and depth: unlit surface properties.
#ifndef POINTRT_SHADERS_SHADE_VIEW_GLSL
#define POINTRT_SHADERS_SHADE_VIEW_GLSL
#include "shaders/lib/color.glsl"

Shading shadeNormal(PathState path, SurfaceInteraction point, Material row, Bsdf bsdf, uint pixel) {
    vec3 color = vec3(0.0);
    if (point.t >= 0.0) color = linearFromSrgb(point.normal * 0.5 + 0.5);
    return onlyRadiance(color);
}

Shading shadeDepth(PathState path, SurfaceInteraction point, Material row, Bsdf bsdf, uint pixel) {
    vec3 color = vec3(0.0);
    if (point.t >= 0.0) color = vec3(max(0.0, 1.0 - point.t / params.depth_black));
    return onlyRadiance(color);
}

#endif
