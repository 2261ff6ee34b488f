// SPDX-License-Identifier: Apache-2.0
// Attenuates the shadow rays of LIST_SHADOW_RAYS by an instance of Gaussians. A light sample has only one bit for
// occlusion, so the bit is set with a probability of 1 minus the transmittance; previews, which must not be noisy,
// round instead.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shade/direct_light.glsl"
#include "shaders/shade/gaussian_shadow.glsl"

void main() {
    uint entry = listEntry(balancedLane());
    bool live = entry != NO_INDEX;
    ShadowRay shadow = shadowRayOfEntry(live ? entry : 0u);
    float passes = passedByGaussians(shadow, live);
    if (!live) return;
    uint path = pathOfEntry(entry), number = lightSampleOfEntry(entry);
    uint pair = dimensionPair(light_queries[path].bounce, PAIR_LIGHT_CHOICE) + PAIRS_PER_BOUNCE * number;
    // a different seed for each instance, so that the transmittances of all instances multiply
    uint seed = ~params.seed ^ instance.grid_size.w * 0x9E3779B9u;
    float u = hasStep(STEP_PREVIEW) ? 0.5 : sample2(imagePixel(path), push.sample_index, pair, seed).x;
    if (u >= passes) atomicOr(light_masks[path], 1u << number);
}
