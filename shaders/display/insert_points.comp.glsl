// SPDX-License-Identifier: Apache-2.0
// Inserts the traced samples of the listed pixels into the cache. A lane for each.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/hit_point.glsl"
#include "shaders/display/displayed_color.glsl"

// Maximum number of samples to average if light is noise-free: it smooths soft shadows, and the first new sample halves
// the error of a wrongly reprojected colour.
const uint kNoiselessSamples = 1u;

uint tracedColor(uint slot) {
    vec3 light = vec3(0.0);
    light += film[LAYER_DIRECT * params.film_stride + slot].rgb;
    light += film[LAYER_INDIRECT * params.film_stride + slot].rgb;
    light += film[LAYER_CAUSTIC * params.film_stride + slot].rgb;
    return displayedColor(light * params.gain, params.display);
}

// An unused place, or else one whose point is not visible. There are more places than pixels.
uint allocatePoint() {
    uint i = atomicAdd(control.point_count, 1u);
    if (i < params.points) return i;
    for (uint tries = 0u; tries < params.points; ++tries) {
        i = atomicAdd(control.cursor, 1u) % params.points;
        if (atomicExchange(is_visible[i], 1u) == 0u) return i;
    }
    return NO_INDEX;
}

uint sampleCount(uint info) { return info >> POINT_SAMPLES_SHIFT & POINT_MAX_SAMPLES; }

// Weight of a new sample in the mean, in units of 1/256.
uint blendWeight(uint before, uint now) {
    bool is_replaced = (before & (POINT_INTERPOLATED | POINT_INVALID)) != 0u ||
                       (params.camera_moves != 0u && (now & POINT_VIEW_DEPENDENT) != 0u);
    uint most = params.is_noisy != 0u ? POINT_MAX_SAMPLES : kNoiselessSamples;
    return is_replaced ? 256u : 256u / (min(sampleCount(before), most) + 1u);
}

void addToTile(uint tile, uvec3 color, bool is_surface) {
    atomicAdd(tiles[tile].red, color.r);
    atomicAdd(tiles[tile].green, color.g);
    atomicAdd(tiles[tile].blue, color.b);
    atomicAdd(tiles[tile].count, 1u);
    atomicAdd(tiles[tile].surfaces, is_surface ? 1u : 0u);
}

void insertPoint(uint pixel, HitPoint point, uint color) {
    uint i = hasPoint(pixel) ? seen[pixel] : allocatePoint();
    if (i == NO_INDEX) return;
    points[i] = vec4(point.position, uintBitsToFloat(point.info));
    point_colors[i] = shown[pixel] = color;
    is_visible[i] = 1u;
    seen[pixel] = i;
    nearest[pixel] = uvec2(floatBitsToUint(point.depth), i);
}

void main() {
    if (lane() >= min(control.selected, params.listed)) return;
    uint word = pixel_list[lane()], color = tracedColor(lane());
    uvec2 place = uvec2(word & 0xFFFFu, word >> 16);
    uint pixel = pixelAt(place), before = hasPoint(pixel) ? infoOf(seen[pixel]) : POINT_INVALID;
    HitPoint point = hitPoint(place, lane());
    uint share = blendWeight(before, point.info), samples = share == 256u ? 1u : min(sampleCount(before) + 1u, POINT_MAX_SAMPLES);
    point.info |= samples << POINT_SAMPLES_SHIFT;
    // differences due to noise are not errors
    if (hasPoint(pixel) && params.is_noisy == 0u) {
        uvec3 a = channelsOf(shown[pixel]), b = channelsOf(color), off = max(a, b) - min(a, b);
        atomicMax(recorded[tileAt(place)], max(off.r, max(off.g, off.b)));
    }
    addToTile(tileAt(place), channelsOf(color), (point.info & POINT_IS_SKY) == 0u);
    insertPoint(pixel, point, mixColors(shown[pixel], color, share));
}
