// SPDX-License-Identifier: Apache-2.0
// The fused form's shadow rays: what they bring reaches the film unless an instance stands in their way. Of those that
// are sifted for targets, another program brings it (bring.comp.glsl).
#version 460
#extension GL_GOOGLE_include_directive : require
#define ANY_HIT
#include "shaders/shade/film.glsl"
#include "shaders/shade/shadow_ray.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/trace.glsl"

// Where another instance has stopped it, t_max is negative.
bool isStopped(ShadowRay ray) {
    bool own = ray.owner == instance.materials.x;
    return trace(TraceRay(cubePoint(ray.origin), cubeDirection(ray.direction), 0.0, ray.t_max * cubeScale(),
                          cubeDirection(ray.left_normal), own ? ray.own_t * cubeScale() : 0.0)).disc != NO_INDEX;
}

void main() {
    uint path = listEntry(balancedLane());
    if (path == NO_INDEX) return;
    ShadowRay ray = loadShadowRay(path);
    bool stopped = isStopped(ray);
    if (!hasStep(STEP_LAST)) {
        if (stopped) shadow_rays[path].t_max = -1.0;
        return;
    }
    if (!stopped && ray.t_max >= 0.0) addLight(path, ray.light, ray.scatterings);
}
