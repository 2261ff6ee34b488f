// SPDX-License-Identifier: Apache-2.0
// Sums over the samples.
#ifndef POINTRT_SHADERS_FILM_GLSL
#define POINTRT_SHADERS_FILM_GLSL
#include "shaders/frame/path.glsl"
#include "shaders/math/color.glsl"

uint filmIndex(uint path, uint layer) { return layer * params.film_pixels + params.film_first + bandPixel(path); }

// Adds light that was scattered this many times on its way from its source to the pixel. Each word that is read or
// written takes its time: black costs none.
void addLight(uint path, vec3 light, uint scatterings) {
    if (light == vec3(0.0)) return;
    film[filmIndex(path, scatterings <= 1u ? LAYER_DIRECT : LAYER_INDIRECT)].rgb += light;
    film[filmIndex(path, LAYER_INDIRECT)].w += luminance(light);
}

// The first light of a sample, and what it sees: covered is 1 where that is the scene itself, and albedo then its own.
// What the last sample came to is squared and summed; the first one clears all.
void beginSample(uint path, bool first, vec3 light, float covered, vec3 albedo) {
    uint direct = filmIndex(path, LAYER_DIRECT), indirect = filmIndex(path, LAYER_INDIRECT);
    uint caustic = filmIndex(path, LAYER_CAUSTIC), albedos = filmIndex(path, LAYER_ALBEDO);
    if (first) {
        film[direct] = vec4(light, covered);
        film[indirect] = vec4(vec3(0.0), luminance(light));
        film[caustic] = vec4(0.0);
        film[albedos] = vec4(albedo, 0.0);
        return;
    }
    float last = film[indirect].w;
    film[direct] += vec4(light, covered);
    film[indirect].w = luminance(light);
    film[caustic].w += last * last;
    if (covered > 0.0) film[albedos] += vec4(albedo, 0.0);
}

#endif
