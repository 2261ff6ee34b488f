// SPDX-License-Identifier: Apache-2.0
// Two-sided rectangular area light.
#ifndef POINTRT_SHADERS_QUAD_LIGHT_GLSL
#define POINTRT_SHADERS_QUAD_LIGHT_GLSL
#include "shaders/shade/light_sample.glsl"

const vec2 kMiddleQuad = vec2(0.5, 0.5);
const bool kBsdfSamplesHitQuad = true;

// The rectangle in a frame with the shaded point at the origin: [lo, hi] in the plane at depth.
struct SeenQuad {
    vec3 x_axis;
    vec3 y_axis;
    vec3 z_axis; // from the point to the plane
    vec2 lo;
    vec2 hi;
    float depth;
    float area;
    float squared_distance; // to its centre
};

// Rectangles nearer than five times their diagonal are sampled by solid angle. Farther ones are sampled by area, since
// differences of their angles would cancel and the two methods differ little.
const float kSolidAngleReach = 25.0;

SeenQuad seeQuad(Light light, vec3 point) {
    vec3 way = light.position.xyz - point;
    float u = length(light.edge_u.xyz), v = length(light.edge_v.xyz);
    SeenQuad quad;
    quad.x_axis = light.edge_u.xyz / u;
    quad.y_axis = light.edge_v.xyz / v;
    float depth = dot(way, light.axis.xyz);
    quad.z_axis = depth < 0.0 ? -light.axis.xyz : light.axis.xyz;
    quad.depth = abs(depth);
    vec2 center = vec2(dot(way, quad.x_axis), dot(way, quad.y_axis));
    quad.lo = center - vec2(u, v);
    quad.hi = center + vec2(u, v);
    quad.area = 4.0 * u * v;
    quad.squared_distance = dot(way, way);
    return quad;
}

bool isNear(SeenQuad quad) {
    vec2 size = quad.hi - quad.lo;
    return quad.squared_distance < kSolidAngleReach * dot(size, size);
}

// Sines of the angles that two lengths subtend at a distance.
vec2 seenSine(vec2 len, float distance) { return len * inversesqrt(len * len + distance * distance); }

// Signed solid angle of the rectangle from x = 0 to x and from y.x to y.y at depth: asin(s(x) s(y.y)) - asin(s(x)
// s(y.x)), where s(l) is the sine of the angle that l subtends. Computed as one angle whose sine and cosine do not
// cancel.
float stripAngle(float x, vec2 y, float depth) {
    float squared = x * x + depth * depth;
    float lo = sqrt(squared + y.x * y.x), hi = sqrt(squared + y.y * y.y);
    float sine = abs(x) * depth * (y.y * lo - y.x * hi), cosine = depth * depth * lo * hi + x * x * y.x * y.y;
    float angle = arcOf(cosine, max(sine, 0.0));
    return x < 0.0 ? -angle : angle;
}

// stripAngle of both ends of the rectangle in x; their difference is its solid angle.
vec2 endAngles(SeenQuad quad) {
    vec2 y = vec2(quad.lo.y, quad.hi.y);
    return vec2(stripAngle(quad.lo.x, y, quad.depth), stripAngle(quad.hi.x, y, quad.depth));
}

float nearQuadPdf(vec2 ends) { return 1.0 / max(ends.y - ends.x, 1.0 / kHighestPdf); }

// The tangent of the angle whose sine is given.
float tangentOf(float sine) {
    float s = clamp(sine, -0.9999999, 0.9999999);
    return s * inversesqrt(1.0 - s * s);
}

// Point of the rectangle, uniform over solid angle. Urena, Fajardo and King, An Area-Preserving Parametrization for
// Spherical Rectangles (EGSR 2013); stripAngle is solved for x in a form with less cancellation:
// sin a = s hi and sin(a - angle) = s lo give s^2 = sin^2(angle) / (hi^2 + lo^2 - 2 hi lo cos(angle)).
vec2 solidAnglePoint(SeenQuad quad, vec2 ends, vec2 u) {
    vec2 y = vec2(quad.lo.y, quad.hi.y), seen = seenSine(y, quad.depth);
    float angle = mix(ends.x, ends.y, u.x);
    float sine = sin(0.5 * angle), cosine = cos(0.5 * angle), product = seen.x * seen.y;
    float span = product > 0.0 ? seen.y - seen.x : seen.y + seen.x, arc = product > 0.0 ? sine : cosine;
    float squared = max(span * span + 4.0 * abs(product) * arc * arc, 1e-30);
    float x = clamp(quad.depth * tangentOf(2.0 * sine * cosine * inversesqrt(squared)), quad.lo.x, quad.hi.x);
    // along y, at this x, areas on the sphere are proportional to differences of sines
    float across = sqrt(x * x + quad.depth * quad.depth);
    vec2 heights = seenSine(y, across);
    return vec2(x, clamp(across * tangentOf(mix(heights.x, heights.y, u.y)), quad.lo.y, quad.hi.y));
}

LightSample sampleQuad(Light light, vec3 point, vec2 u) {
    SeenQuad quad = seeQuad(light, point);
    vec2 ends = endAngles(quad);
    bool near = isNear(quad);
    vec2 at = near ? solidAnglePoint(quad, ends, u) : mix(quad.lo, quad.hi, u);
    vec3 way = at.x * quad.x_axis + at.y * quad.y_axis + quad.depth * quad.z_axis;
    float squared = max(dot(way, way), 1e-30), distance = sqrt(squared);
    // the rectangle's solid angle if all its points were at this distance and angle
    float seen_area = quad.area * quad.depth / (squared * distance);
    float solid_angle = near ? max(ends.y - ends.x, 0.0) : seen_area;
    float pdf = near ? nearQuadPdf(ends) : 1.0 / max(seen_area, 1.0 / kHighestPdf);
    return LightSample(way / distance, distance, light.power.xyz * solid_angle, pdf);
}

float pdfQuad(Light light, vec3 point, vec3 direction) {
    SeenQuad quad = seeQuad(light, point);
    vec2 ends = endAngles(quad);
    float cosine = abs(dot(direction, quad.z_axis));
    // the distance is depth / cosine
    float density = quad.depth * quad.depth / max(quad.area * cosine * cosine * cosine, 1e-30);
    return isNear(quad) ? nearQuadPdf(ends) : min(density, kHighestPdf);
}

vec3 radianceQuad(Light light) { return light.power.xyz; }

#endif
