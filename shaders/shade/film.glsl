// SPDX-License-Identifier: Apache-2.0
// Film accumulation: sums over the samples of each pixel.
#ifndef POINTRT_SHADERS_FILM_GLSL
#define POINTRT_SHADERS_FILM_GLSL
#include "shaders/lib/path.glsl"
#include "shaders/lib/color.glsl"

uint filmIndex(uint path, uint layer) { return layer * params.film_pixels + params.film_first + bandPixel(path); }

// Accumulates light that was scattered this many times on its way from its source to the pixel. Skips black, to save
// memory traffic.
void accumulateLight(uint path, vec3 light, uint scatterings) {
    if (light == vec3(0.0)) return;
    film[filmIndex(path, scatterings <= 1u ? LAYER_DIRECT : LAYER_INDIRECT)].rgb += light;
    film[filmIndex(path, LAYER_INDIRECT)].w += luminance(light);
}

// The sums of a pixel in registers while a path adds to them: the film layers of these names.
struct PixelSums {
    vec4 direct;
    vec4 indirect;
    vec4 caustic; // loaded only if the program may change it
};

PixelSums loadSums(uint path) {
    return PixelSums(film[filmIndex(path, LAYER_DIRECT)], film[filmIndex(path, LAYER_INDIRECT)],
                     kGathersPhotons || kCameraPass ? film[filmIndex(path, LAYER_CAUSTIC)] : vec4(0.0));
}

void storeSums(uint path, PixelSums sums) {
    film[filmIndex(path, LAYER_DIRECT)] = sums.direct;
    film[filmIndex(path, LAYER_INDIRECT)] = sums.indirect;
    if (kGathersPhotons || kCameraPass) film[filmIndex(path, LAYER_CAUSTIC)] = sums.caustic;
}

void accumulateLight(inout PixelSums sums, vec3 light, uint scatterings) {
    sums.direct.rgb += scatterings <= 1u ? light : vec3(0.0);
    sums.indirect += vec4(scatterings <= 1u ? vec3(0.0) : light, luminance(light));
}

void accumulateCaustic(inout PixelSums sums, vec3 light) {
    sums.caustic.rgb += light;
    sums.indirect.w += luminance(light);
}

// The sums at the start of a sample, like beginSample.
PixelSums beginSums(PixelSums before, bool first, float covered) {
    if (first) return PixelSums(vec4(vec3(0.0), covered), vec4(0.0), vec4(0.0));
    float last = before.indirect.w;
    return PixelSums(before.direct + vec4(vec3(0.0), covered), vec4(before.indirect.rgb, 0.0),
                     before.caustic + vec4(vec3(0.0), last * last));
}

void accumulateAlbedo(uint path, bool first, float covered, vec3 albedo) {
    uint albedos = filmIndex(path, LAYER_ALBEDO);
    if (first) film[albedos] = vec4(albedo, 0.0);
    if (!first && covered > 0.0) film[albedos] += vec4(albedo, 0.0);
}

// Starts a sample: accumulates its first light, coverage (1 if the scene itself is hit) and the albedo of the hit. Adds
// the squared luminance of the previous sample to the sum of squares. The first sample clears the film.
void beginSample(uint path, bool first, vec3 light, float covered, vec3 albedo) {
    uint direct = filmIndex(path, LAYER_DIRECT), indirect = filmIndex(path, LAYER_INDIRECT);
    uint caustic = filmIndex(path, LAYER_CAUSTIC);
    if (first) {
        film[direct] = vec4(light, covered);
        film[indirect] = vec4(vec3(0.0), luminance(light));
        film[caustic] = vec4(0.0);
        accumulateAlbedo(path, first, covered, albedo);
        return;
    }
    float last = film[indirect].w;
    film[direct] += vec4(light, covered);
    film[indirect].w = luminance(light);
    film[caustic].w += last * last;
    accumulateAlbedo(path, first, covered, albedo);
}

#endif
