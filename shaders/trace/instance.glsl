// SPDX-License-Identifier: Apache-2.0
// What programs know of an instance when they are built, and the ways from render space to its cube and back. The map is
// a similarity, so discs stay discs.
#ifndef POINTRT_SHADERS_INSTANCE_GLSL
#define POINTRT_SHADERS_INSTANCE_GLSL
#include "shaders/shared/spec_constants.h"

// Whether any cell is cut further than a brick does. Even scans have none, and no ray has to ask.
layout(constant_id = SPEC_UNEVEN) const bool kUneven = false;
// Whether normals point outwards: then the two sides of a thin sheet are told apart.
layout(constant_id = SPEC_ORIENTED) const bool kOriented = false;
// Whether it says how far its surface scatters.
layout(constant_id = SPEC_NOISY) const bool kNoisy = false;
// Whether it is a tile of a set, whose hits count in its core alone.
layout(constant_id = SPEC_CORED) const bool kCored = false;

vec3 cubePoint(vec3 render_point) {
    vec4 p = vec4(render_point, 1.0);
    return vec3(dot(instance.row_x, p), dot(instance.row_y, p), dot(instance.row_z, p));
}

// Of unit length where the argument is: lengths along rays are scaled apart, by cubeScale.
vec3 cubeDirection(vec3 render_point) {
    return vec3(dot(instance.row_x.xyz, render_point), dot(instance.row_y.xyz, render_point), dot(instance.row_z.xyz, render_point)) /
           instance.splat.w;
}

vec3 renderDirection(vec3 cube) {
    return (cube.x * instance.row_x.xyz + cube.y * instance.row_y.xyz + cube.z * instance.row_z.xyz) / instance.splat.w;
}

// Cube units in a render unit.
float cubeScale() { return instance.splat.w; }

#endif
