// SPDX-License-Identifier: Apache-2.0
// Sums over the samples.
#ifndef POINTRT_SHADERS_FILM_GLSL
#define POINTRT_SHADERS_FILM_GLSL
#include "bindings.glsl"
#include "color.glsl"

uint filmIndex(uint index, uint layer) { return layer * params.film.x + params.film.y + index; }

// Adds light that was scattered this many times on its way from its source to the pixel.
void addLight(uint index, vec3 light, uint scatterings) {
    film[filmIndex(index, scatterings <= 1u ? LAYER_DIRECT : LAYER_INDIRECT)].rgb += light;
    film[filmIndex(index, LAYER_INDIRECT)].w += luminance(light);
}

// Before the first light of a sample: what the last sample came to is squared and summed; the first clears all.
void beginSample(uint index, bool first) {
    uint indirect = filmIndex(index, LAYER_INDIRECT), caustic = filmIndex(index, LAYER_CAUSTIC);
    float last = first ? 0.0 : film[indirect].w;
    if (first) {
        film[filmIndex(index, LAYER_DIRECT)] = vec4(0.0);
        film[indirect] = vec4(0.0);
        film[caustic] = vec4(0.0);
        film[filmIndex(index, LAYER_ALBEDO)] = vec4(0.0);
        return;
    }
    film[caustic].w += last * last;
    film[indirect].w = 0.0;
}

#endif
