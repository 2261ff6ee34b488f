// SPDX-License-Identifier: Apache-2.0
// The box around all instances, tested before rays are queued for intersection with instances.
#ifndef POINTRT_SHADERS_INSTANCE_BOUNDS_GLSL
#define POINTRT_SHADERS_INSTANCE_BOUNDS_GLSL
#include "shaders/lib/math.glsl"

// Whether a ray enters the box around all instances before t_max.
bool mayHitInstances(vec3 origin, vec3 direction, float t_max) {
    // a component of 0 would give NaN products
    vec3 inverse = 1.0 / mix(direction, vec3(1e-20), lessThan(abs(direction), vec3(1e-20)));
    vec3 to_low = (params.instances_low - origin) * inverse, to_high = (params.instances_high - origin) * inverse;
    float near = largest(min(to_low, to_high)), far = -largest(-max(to_low, to_high));
    return params.instances_low.x <= params.instances_high.x && near <= far && far >= 0.0 && near < t_max;
}

#endif
