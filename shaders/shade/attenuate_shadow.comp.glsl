// SPDX-License-Identifier: Apache-2.0
// Attenuates the shadow rays of LIST_SHADOW_RAYS by an instance of Gaussians. A light sample has a bit for whether it is
// occluded, so it is occluded with the probability that its light does not pass; previews, which show no noise, round.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/direct_light.glsl"
#include "shaders/trace/splat.glsl"
#include "shaders/trace/gaussian_transmittance.glsl"

void main() {
    uint entry = listEntry(balancedLane());
    bool live = entry != NO_INDEX, enters;
    ShadowRay shadow = shadowRayOfEntry(live ? entry : 0u);
    GaussianRay ray = gaussianRay(shadow.origin, shadow.direction, shadow.t_max * cubeScale(), enters);
    float passes = gaussianTransmittance(ray, enters, live && shadow.t_max > 0.0);
    if (!live) return;
    uint path = pathOfEntry(entry), number = lightSampleOfEntry(entry);
    uint pair = dimensionPair(light_queries[path].bounce, PAIR_LIGHT_CHOICE) + PAIRS_PER_BOUNCE * number;
    float u = hasStep(STEP_PREVIEW) ? 0.5 : sample2(imagePixel(path), push.sample_index, pair, ~params.seed).x;
    if (u >= passes) atomicOr(light_masks[path], 1u << number);
}
