// SPDX-License-Identifier: Apache-2.0
// Integrators normal and depth: unlit surface properties.
#ifndef POINTRT_SHADERS_SHADE_VIEW_GLSL
#define POINTRT_SHADERS_SHADE_VIEW_GLSL
#include "shaders/shade/surface_view.glsl"

Shading shadeNormal(PathState path, SurfaceInteraction point, Material row, Bsdf bsdf, uint pixel) {
    vec3 color = vec3(0.0);
    if (point.t >= 0.0) color = normalColor(point.normal);
    return onlyRadiance(color);
}

Shading shadeDepth(PathState path, SurfaceInteraction point, Material row, Bsdf bsdf, uint pixel) {
    vec3 color = vec3(0.0);
    if (point.t >= 0.0) color = depthColor(point.t);
    return onlyRadiance(color);
}

#endif
