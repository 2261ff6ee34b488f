// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_REACH_GLSL
#define POINTRT_SHADERS_REACH_GLSL
#include "shaders/lib/math.glsl"

// Whether a ray comes before t_max to where instances are.
bool meetsInstances(vec3 origin, vec3 direction, float t_max) {
    // a component of 0 would make products that are no numbers
    vec3 inverse = 1.0 / mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
    vec3 to_low = (params.reach_low - origin) * inverse, to_high = (params.reach_high - origin) * inverse;
    float near = largest(min(to_low, to_high)), far = -largest(-max(to_low, to_high));
    return params.reach_low.x <= params.reach_high.x && near <= far && far >= 0.0 && near < t_max;
}

#endif
