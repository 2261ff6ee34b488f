// SPDX-License-Identifier: Apache-2.0
// Projects the points into the view, with a depth test. A lane for each point.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/point_cache.glsl"

uvec2 projectPoint(uint i) {
    uint info = infoOf(i);
    bool is_sky = (info & POINT_IS_SKY) != 0u;
    vec3 offset = points[i].xyz - (is_sky ? vec3(0.0) : params.eye);
    float depth = dot(offset, params.forward);
    float half_height = (is_sky ? 0.0 : params.half_window) + depth * params.tan_half_fov;
    vec2 middle = 0.5 * vec2(params.width, params.height);
    vec2 plane = vec2(dot(offset, params.right) / params.aspect, -dot(offset, params.up)) / half_height;
    vec2 at = middle * plane + middle;
    bool is_inside = depth > 0.0 && half_height > 0.0 && at.x >= 0.0 && at.y >= 0.0 && at.x < float(params.width) &&
                     at.y < float(params.height);
    if ((info & POINT_INVALID) != 0u || !is_inside) return uvec2(NO_INDEX);
    return uvec2(pixelAt(uvec2(at)), floatBitsToUint(is_sky ? kSkyDepth : depth));
}

void main() {
    if (lane() >= pointCount()) return;
    uvec2 at = projectPoint(lane());
    projected[lane()] = at;
    if (at.x != NO_INDEX) atomicMin(nearest[at.x].x, at.y);
}
