// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_MATH_GLSL
#define POINTRT_SHADERS_MATH_GLSL

const float kPi = 3.14159265358979;

float largest(vec3 v) { return max(v.x, max(v.y, v.z)); }

#endif
