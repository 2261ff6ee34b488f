// SPDX-License-Identifier: Apache-2.0
// Two-sided disc light. Sampled by area, which has low variance if all points of the disc are about equally far away.
// From points nearer than the radius, where the variance of area sampling is unbounded, sampled by the solid angle of
// the square around the disc, whose corners emit nothing (Gamito, Solid Angle Sampling of Disk and Cylinder Lights,
// EGSR 2016).
#ifndef POINTRT_SHADERS_DISC_LIGHT_GLSL
#define POINTRT_SHADERS_DISC_LIGHT_GLSL
#include "shaders/shade/quad_light.glsl"

const vec2 kMiddleDisc = vec2(0.5, 0.5);
const bool kBsdfSamplesHitDisc = true;

float discRadius(Light light) { return length(light.edge_u.xyz); }

bool isNearDisc(SeenQuad square, float radius) { return square.squared_distance < radius * radius; }

// Uniform point of the unit disc that preserves neighbourhoods. Shirley and Chiu, A Low Distortion Map Between
// Disk and Square (1997).
vec2 concentricPoint(vec2 u) {
    vec2 from_middle = 2.0 * u - 1.0;
    bool across = abs(from_middle.x) > abs(from_middle.y);
    float radius = across ? from_middle.x : from_middle.y, other = across ? from_middle.y : from_middle.x;
    float angle = radius != 0.0 ? 0.25 * kPi * other / radius : 0.0;
    vec2 along = radius * vec2(cos(angle), sin(angle));
    return across ? along : along.yx;
}

LightSample sampleDisc(Light light, vec3 point, vec2 u) {
    SeenQuad square = seeQuad(light, point);
    vec2 ends = endAngles(square), center = 0.5 * (square.lo + square.hi);
    float radius = discRadius(light);
    bool near = isNearDisc(square, radius);
    vec2 at = near ? solidAnglePoint(square, ends, u) : center + radius * concentricPoint(u), off = at - center;
    vec3 way = at.x * square.x_axis + at.y * square.y_axis + square.depth * square.z_axis;
    float squared = max(dot(way, way), 1e-30), distance = sqrt(squared);
    // the disc's solid angle if all its points were at this distance and angle
    float seen_area = kPi * radius * radius * square.depth / (squared * distance);
    float square_angle = dot(off, off) < radius * radius ? max(ends.y - ends.x, 0.0) : 0.0;
    float pdf = near ? nearQuadPdf(ends) : 1.0 / max(seen_area, 1.0 / kHighestPdf);
    return LightSample(way / distance, distance, light.power.xyz * (near ? square_angle : seen_area), pdf);
}

float pdfDisc(Light light, vec3 point, vec3 direction) {
    SeenQuad square = seeQuad(light, point);
    vec2 ends = endAngles(square);
    float radius = discRadius(light), cosine = abs(dot(direction, square.z_axis));
    // the distance is depth / cosine
    float density = square.depth * square.depth / max(kPi * radius * radius * cosine * cosine * cosine, 1e-30);
    return isNearDisc(square, radius) ? nearQuadPdf(ends) : min(density, kHighestPdf);
}

vec3 radianceDisc(Light light) { return light.power.xyz; }

#endif
