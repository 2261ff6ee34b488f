// SPDX-License-Identifier: Apache-2.0
// Which lights reach the points that ask for them, as far as the surfaces' own facing and shapes say. Lists the shadow
// rays that may meet instances.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#include "shaders/shade/direct_light.glsl"
#include "shaders/shade/shape_shadow.glsl"
#include "shaders/trace/shape_hit.glsl"
#include "shaders/lib/append.glsl"
#include "shaders/trace/reach.glsl"

void main() {
    uint path;
    DirectLightQuery query = currentLightQuery(path);
    bool live = path != NO_INDEX;
    uint first = push.first_turn, end = min(lightTurns(), first + ASKED_TURNS), asked = 0u;
    uint mask = live && first > 0u ? light_masks[path] : 0u;
    for (uint turn = first; turn < end; turn++) {
        // while things move, the key light's shadows alone: they say where things stand
        bool shadows = hasOption(OPTION_SHADOWS) && (!hasStep(STEP_PREVIEW) || turn == 0u);
        Light light;
        LightSample to = sampleTurn(query, live ? path : 0u, turn, light);
        bool faces = live && facesLight(query, to);
        float own_t;
        vec3 origin = leaveSurface(query.position, query.normal, query.radius, query.material, to.direction, own_t);
        ShapeHit hit = nearestShape(ofLane(params.shape_count), origin, to.direction, nearestFrom(query.owner, origin));
        bool dark = !faces || (shadows && hides(hit, to, light));
        mask |= dark ? 1u << turn : 0u;
        asked += faces && shadows ? 1u : 0u;
        bool meets = meetsInstances(origin, to.direction, to.distance * kBeforeLamp);
        appendEntry(LIST_TURNS, shadows && !dark && meets, path | turn << ASKED_TURN_SHIFT);
    }
    asked = subgroupAdd(asked);
    if (subgroupElect() && asked > 0u) atomicAdd(control.shadow_rays, asked);
    if (live) light_masks[path] = mask;
}
