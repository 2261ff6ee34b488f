// SPDX-License-Identifier: Apache-2.0
// Adds the light of the current sample to the film.
#ifndef POINTRT_SHADERS_FILM_GLSL
#define POINTRT_SHADERS_FILM_GLSL
#include "shaders/lib/path.glsl"
#include "shaders/lib/color.glsl"
#include "shaders/shade/film_pixel.glsl"

uint filmIndex(uint path, uint layer) { return layer * params.film_pixels + params.film_first + bandPixel(path); }

// Accumulates light that was scattered this many times on its way from its source to the pixel. Skips black, to save
// memory traffic.
void accumulateLight(uint path, vec3 light, uint scatterings) {
    if (light == vec3(0.0)) return;
    film[filmIndex(path, scatterings <= 1u ? LAYER_DIRECT : LAYER_INDIRECT)].rgb +=
        light * sampleShare(push.sample_index);
    film[filmIndex(path, LAYER_INDIRECT)].w += luminance(light);
}

void accumulateCaustic(uint path, vec3 light) {
    film[filmIndex(path, LAYER_CAUSTIC)].rgb += light * sampleShare(push.sample_index);
    film[filmIndex(path, LAYER_INDIRECT)].w += luminance(light);
}

FilmPixel loadFilmPixel(uint path) {
    return FilmPixel(film[filmIndex(path, LAYER_DIRECT)], film[filmIndex(path, LAYER_INDIRECT)],
                     kGathersPhotons || kCameraPass ? film[filmIndex(path, LAYER_CAUSTIC)] : vec4(0.0),
                     kCameraPass ? film[filmIndex(path, LAYER_ALBEDO)] : vec4(0.0));
}

void storeFilmPixel(uint path, FilmPixel pixel) {
    film[filmIndex(path, LAYER_DIRECT)] = pixel.direct;
    film[filmIndex(path, LAYER_INDIRECT)] = pixel.indirect;
    if (kGathersPhotons || kCameraPass) film[filmIndex(path, LAYER_CAUSTIC)] = pixel.caustic;
    if (kCameraPass) film[filmIndex(path, LAYER_ALBEDO)] = pixel.albedo;
}

#endif
