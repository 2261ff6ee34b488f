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

// A pixel's sums, for as long as a path adds to them.
struct PixelSums {
    vec4 direct; // the film's layers of that name
    vec4 indirect;
};

PixelSums loadSums(uint path) {
    return PixelSums(film[filmIndex(path, LAYER_DIRECT)], film[filmIndex(path, LAYER_INDIRECT)]);
}

void storeSums(uint path, PixelSums sums) {
    film[filmIndex(path, LAYER_DIRECT)] = sums.direct;
    film[filmIndex(path, LAYER_INDIRECT)] = sums.indirect;
}

void addLight(inout PixelSums sums, vec3 light, uint scatterings) {
    sums.direct.rgb += scatterings <= 1u ? light : vec3(0.0);
    sums.indirect += vec4(scatterings <= 1u ? vec3(0.0) : light, luminance(light));
}

// A sample's sums before its first light, as beginSample begins it.
PixelSums beginSums(uint path, bool live, float covered, vec3 albedo) {
    bool first = push.sample_index == 0u;
    PixelSums sums = loadSums(path);
    float last = sums.indirect.w;
    sums.direct = first ? vec4(vec3(0.0), covered) : sums.direct + vec4(vec3(0.0), covered);
    sums.indirect = first ? vec4(0.0) : vec4(sums.indirect.rgb, 0.0);
    uint caustic = filmIndex(path, LAYER_CAUSTIC), albedos = filmIndex(path, LAYER_ALBEDO);
    if (live && first) film[caustic] = vec4(0.0);
    if (live && !first) film[caustic].w += last * last;
    if (live && first) film[albedos] = vec4(albedo, 0.0);
    if (live && !first && covered > 0.0) film[albedos] += vec4(albedo, 0.0);
    return sums;
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
