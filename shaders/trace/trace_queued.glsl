// SPDX-License-Identifier: Apache-2.0
// Intersects the ray of a queued path with one instance. ANY_HIT: see trace.glsl.
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/queue.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"

// Up to t_max, in cube units.
TraceHit tracePath(uint path, float t_max) {
    uvec4 origin = loadPathTexel(path, PATH_ORIGIN), left = loadPathTexel(path, PATH_SELF_NORMAL);
    return trace(secondaryRay(asVector(origin), asVector(loadPathTexel(path, PATH_DIRECTION)), t_max, asVector(left),
                              left.w >> PATH_OWNER_SHIFT, asFloat(origin.w)));
}
