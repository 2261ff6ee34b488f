// SPDX-License-Identifier: Apache-2.0
// Intersects the ray of a queued path with one instance. ANY_HIT: see trace.glsl.
#include "shaders/lib/bindings.glsl"
#include "shaders/lib/queue.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"

// The part of a PathState that tracing needs.
struct QueuedRay {
    vec3 origin;
    float self_t;
    vec3 direction;
    vec3 self_normal;
    uint owner;
};

QueuedRay queuedRay(uint path) {
    uvec4 origin = loadPathTexel(path, PATH_ORIGIN), left = loadPathTexel(path, PATH_SELF_NORMAL);
    return QueuedRay(asVector(origin), asFloat(origin.w), asVector(loadPathTexel(path, PATH_DIRECTION)), asVector(left),
                     left.w >> PATH_OWNER_SHIFT);
}

// Up to t_max, in cube units.
TraceHit traceQueued(QueuedRay ray, float t_max) {
    return trace(secondaryRay(ray.origin, ray.direction, t_max, ray.self_normal, ray.owner, ray.self_t));
}

TraceHit tracePath(uint path, float t_max) { return traceQueued(queuedRay(path), t_max); }
