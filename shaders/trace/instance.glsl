// SPDX-License-Identifier: Apache-2.0
// Traits of an instance as specialization constants, and transforms between render space and its cube. The transform is
// a similarity, so discs stay discs and balls stay balls.
#ifndef POINTRT_SHADERS_INSTANCE_GLSL
#define POINTRT_SHADERS_INSTANCE_GLSL
#include "shaders/shared/spec_constants.h"

// Whether any cell is subdivided below the bricks. If not, traversal skips the descent.
layout(constant_id = SPEC_UNEVEN) const bool kUneven = false;
// Whether normals are oriented outwards: then the two sides of a thin sheet are distinguished.
layout(constant_id = SPEC_ORIENTED) const bool kOriented = false;
// Whether the scan stores the noise of its surface.
layout(constant_id = SPEC_NOISY) const bool kNoisy = false;
// Whether the instance is a tile of a set: hits are clipped to the tile's core.
layout(constant_id = SPEC_CLIPS_TO_CORE) const bool kClipsToCore = false;
// Whether the scene has clips, which may cut the instance.
layout(constant_id = SPEC_CLIPPED) const bool kClipped = false;
// Whether splats may be balls. If not, programs test discs only.
layout(constant_id = SPEC_HAS_BALLS) const bool kHasBalls = false;

vec3 cubePoint(vec3 render_point) {
    vec4 p = vec4(render_point, 1.0);
    return vec3(dot(instance.row_x, p), dot(instance.row_y, p), dot(instance.row_z, p));
}

// Preserves length: distances along rays are scaled separately, by cubeScale.
vec3 cubeDirection(vec3 render) {
    return vec3(dot(instance.row_x.xyz, render), dot(instance.row_y.xyz, render), dot(instance.row_z.xyz, render)) /
           instance.splat.w;
}

vec3 renderDirection(vec3 cube) {
    return (cube.x * instance.row_x.xyz + cube.y * instance.row_y.xyz + cube.z * instance.row_z.xyz) / instance.splat.w;
}

// Cube units per render unit.
float cubeScale() { return instance.splat.w; }

#endif
