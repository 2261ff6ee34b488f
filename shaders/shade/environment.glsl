// SPDX-License-Identifier: Apache-2.0
// Environment image: radiance, and importance sampling of directions (Pharr, Jakob and Humphreys, Physically Based
// Rendering, "Piecewise-Constant 2D Distributions"). Data: runtime/device_scene/environment.h. The program defines
//   loadEnvironmentTexel(i)  rgb of texel i of the image, row by row
//   loadEnvironmentCdf(i)    word i of the cumulative distributions: rows + 1 for the rows, then columns + 1 for each
//                            row
#ifndef POINTRT_SHADERS_ENVIRONMENT_GLSL
#define POINTRT_SHADERS_ENVIRONMENT_GLSL

#include "shaders/shared/environment_layout.h"
#include "shaders/lib/math.glsl"

// Unit world direction to (u, v) in the image and the sine of the angle to the zenith.
vec3 environmentPoint(EnvironmentFrame frame, vec3 direction) {
    const vec3 d =
        vec3(dot(frame.row_x.xyz, direction), dot(frame.row_y.xyz, direction), dot(frame.row_z.xyz, direction));
    const float sine = length(d.xz);
    const float azimuth = sine > 0.0 ? atan(d.x, -d.z) : 0.0; // atan(0, 0) is undefined in GLSL
    return vec3(0.5 + azimuth / (2.0 * kPi), atan(sine, d.y) / kPi, sine);
}

// Bilinear lookup between texel centres; wraps around the horizon, clamps at the poles.
vec3 environmentLookup(EnvironmentFrame frame, vec2 uv) {
    const ivec2 size = ivec2(frame.size.xy);
    const vec2 at = uv * vec2(size) - 0.5;
    const vec2 low = floor(at), share = at - low;
    int x0 = int(low.x), y0 = int(low.y);
    int x1 = x0 + 1, y1 = min(y0 + 1, size.y - 1);
    x0 = x0 < 0 ? size.x - 1 : min(x0, size.x - 1);
    x1 = x1 >= size.x ? 0 : x1;
    y0 = clamp(y0, 0, size.y - 1) * size.x;
    y1 = max(y1, 0) * size.x;
    const vec3 top = mix(loadEnvironmentTexel(y0 + x0).rgb, loadEnvironmentTexel(y0 + x1).rgb, share.x);
    const vec3 bottom = mix(loadEnvironmentTexel(y1 + x0).rgb, loadEnvironmentTexel(y1 + x1).rgb, share.x);
    return mix(top, bottom, share.y) * frame.row_x.w;
}

// Radiance from a unit direction.
vec3 environmentRadiance(EnvironmentFrame frame, vec3 direction) {
    return environmentLookup(frame, environmentPoint(frame, direction).xy);
}

// Density over solid angle, from the probabilities of the row and of the column within the row.
float environmentDensity(EnvironmentFrame frame, float row_share, float column_share, float sine) {
    const float cells = float(frame.size.z * frame.size.w);
    return sine > 0.0 ? row_share * column_share * cells / (2.0 * kPi * kPi * sine) : 0.0;
}

// Density over solid angle with which sampleEnvironment draws a unit direction.
float environmentPdf(EnvironmentFrame frame, vec3 direction) {
    const vec3 point = environmentPoint(frame, direction);
    const ivec2 grid = ivec2(frame.size.zw), cell = clamp(ivec2(point.xy * vec2(grid)), ivec2(0), grid - 1);
    const int column = grid.y + 1 + cell.y * (grid.x + 1) + cell.x;
    return environmentDensity(frame, loadEnvironmentCdf(cell.y + 1) - loadEnvironmentCdf(cell.y),
                              loadEnvironmentCdf(column + 1) - loadEnvironmentCdf(column), point.z);
}

// Inverts the cumulative distribution in words first to first + count for u in [0, 1). x: the cell, from 0, plus the
// fraction within it; y: probability of the cell. Cells of probability 0 are never chosen. All lanes take the same
// number of steps.
vec2 invertEnvironmentCdf(int first, int count, float u) {
    int cell = 0, left = count;
    while (left > 1) {
        const int half_left = left >> 1;
        cell += loadEnvironmentCdf(first + cell + half_left) <= u ? half_left : 0;
        left -= half_left;
    }
    const float before = loadEnvironmentCdf(first + cell), share = loadEnvironmentCdf(first + cell + 1) - before;
    return vec2(float(cell) + (share > 0.0 ? min((u - before) / share, 1.0) : 0.5), share);
}

// Draws a unit world direction for u in [0, 1)^2 and returns the radiance from there. Density 0: no sample.
vec3 sampleEnvironment(EnvironmentFrame frame, vec2 u, out vec3 direction, out float pdf_solid_angle) {
    const ivec2 grid = ivec2(frame.size.zw);
    const vec2 row = invertEnvironmentCdf(0, grid.y, u.y);
    const int cell_y = min(int(row.x), grid.y - 1);
    const vec2 column = invertEnvironmentCdf(grid.y + 1 + cell_y * (grid.x + 1), grid.x, u.x);
    const vec2 uv = vec2(column.x, row.x) / vec2(grid);
    const float theta = uv.y * kPi, phi = (uv.x - 0.5) * 2.0 * kPi, sine = sin(theta);
    const vec3 d = vec3(sine * sin(phi), cos(theta), -sine * cos(phi));
    direction = frame.row_x.xyz * d.x + frame.row_y.xyz * d.y + frame.row_z.xyz * d.z;
    pdf_solid_angle = environmentDensity(frame, row.y, column.y, sine);
    return environmentLookup(frame, uv);
}

#endif
