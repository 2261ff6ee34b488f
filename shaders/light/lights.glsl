// SPDX-License-Identifier: Apache-2.0
// Lights seen from a point: directions to send shadow rays in, and the densities of those directions, by which they are
// weighed against scattered rays that meet a lamp. The sky is sampled elsewhere (LIGHT_SKY has no directions here).
// Points, normals and distances in render units; directions are unit vectors.
#ifndef POINTRT_SHADERS_LIGHTS_GLSL
#define POINTRT_SHADERS_LIGHTS_GLSL

#include "shaders/math/basis.glsl"
#include "shaders/math/math.glsl"
#include "shaders/shared/scene_layout.h"

// A program may say which kinds there are.
#ifndef mayHaveLight
#define mayHaveLight(kind) true
#endif

// To what is not at a distance: the sun.
const float kLightAfar = 1e30;
// Densities end here, where their squares are still finite: a quad seen from its own plane has no solid angle.
const float kHighestPdf = 1e15;

struct LightSample {
    vec3 direction;          // to the light
    float distance;          // to the lamp's surface, where a shadow ray ends
    vec3 radiance_over_pdf;  // what the sample adds to the irradiance of a surface that faces it, were nothing between
    float pdf;               // of the direction, over solid angle; 0: the light has no extent and no ray can meet it
};

uint lightKind(Light light) { return uint(light.position.w); }

// The arc of (x, y), y not negative: 0 to pi, with an error of 3e-7. Vulkan lets atan be off by 4096 units in the last
// place, and solid angles are differences of arcs. Polynomial: Cephes, atanf.
float arcOf(float x, float y) {
    float width = abs(x);
    // turned so that the quotient is at most tan(pi / 8)
    bool steep = y > 2.414213562 * width, middle = !steep && y > 0.414213562 * width;
    float above = steep ? -width : (middle ? y - width : y), below = steep ? y : (middle ? y + width : width);
    float q = below > 0.0 ? above / below : 0.0, s = q * q;
    float series = (((0.0805374449538 * s - 0.138776856032) * s + 0.199777106478) * s - 0.333329491539) * s * q + q;
    float arc = series + (steep ? 0.5 * kPi : (middle ? 0.25 * kPi : 0.0));
    return x < 0.0 ? kPi - arc : arc;
}

// The direction whose angle with axis has a cosine of 1 - from_axis, at turn u (of 1) around it.
vec3 coneDirection(vec3 axis, float from_axis, float u) {
    float sine = sqrt(max(from_axis * (2.0 - from_axis), 0.0)), turn = 2.0 * kPi * u;
    return normalize(frameAround(axis) * vec3(sine * cos(turn), sine * sin(turn), 1.0 - from_axis));
}

// 1 minus the cosine of its angular radius: exact, as cosines near 1 are.
float sunCap(Light light) { return 1.0 - light.axis.w; }

float sunPdf(Light light) {
    float cap = sunCap(light);
    return cap > 0.0 ? 1.0 / (2.0 * kPi * cap) : 0.0;
}

// A disc of constant radiance L gives L pi sin^2 to a surface that faces its middle.
vec3 sunRadiance(Light light) {
    float cap = sunCap(light);
    return cap > 0.0 ? light.power.xyz / (kPi * cap * (2.0 - cap)) : vec3(0.0);
}

// Whether a ray that leaves the scene ends in the sun's disc: by the sine, which has digits where the cosine has none.
bool meetsSun(Light light, vec3 direction) {
    vec3 across = cross(direction, light.axis.xyz);
    float cap = sunCap(light);
    return dot(across, across) < cap * (2.0 - cap) && dot(direction, light.axis.xyz) > 0.0;
}

LightSample sampleSun(Light light, vec2 u) {
    float cap = sunCap(light);
    // radiance over pdf, the cap cancelled
    return LightSample(coneDirection(light.axis.xyz, cap * u.x, u.y), kLightAfar,
                       light.power.xyz * (2.0 / (2.0 - cap)), sunPdf(light));
}

LightSample samplePoint(Light light, vec3 point) {
    vec3 way = light.position.xyz - point;
    float squared = max(dot(way, way), 1e-30);
    return LightSample(way * inversesqrt(squared), sqrt(squared), light.power.xyz / squared, 0.0);
}

LightSample sampleSpot(Light light, vec3 point) {
    LightSample to = samplePoint(light, point);
    float inside = -dot(to.direction, light.axis.xyz) - light.axis.w;
    // a hard edge has both angles alike
    float share = clamp(inside / max(light.edge_u.x - light.axis.w, 1e-7), 0.0, 1.0);
    to.radiance_over_pdf *= share * share * (3.0 - 2.0 * share);
    return to;
}

// The cone of directions that a sphere is sampled in, as 1 minus the cosine of its half angle: from inside all
// directions. Pharr, Jakob and Humphreys, Physically Based Rendering, 6.2.4, in a form that needs no series from afar.
float sphereCap(float squared_distance, float radius) {
    float squared_sine = radius * radius / max(squared_distance, 1e-30);
    return squared_sine < 1.0 ? squared_sine / (1.0 + sqrt(1.0 - squared_sine)) : 2.0;
}

LightSample sampleSphere(Light light, vec3 point, vec2 u) {
    vec3 way = light.position.xyz - point;
    float squared = dot(way, way), radius = light.axis.w;
    float cap = sphereCap(squared, radius);
    vec3 axis = squared > 0.0 ? way * inversesqrt(squared) : vec3(0.0, 0.0, 1.0);
    float from_axis = cap * u.x;
    vec3 direction = coneDirection(axis, from_axis, u.y);
    float middle = sqrt(squared) * (1.0 - from_axis);
    float squared_height = squared * from_axis * (2.0 - from_axis);
    float half_chord = sqrt(max(radius * radius - squared_height, 0.0));
    float distance = max(squared > radius * radius ? middle - half_chord : middle + half_chord, 0.0);
    return LightSample(direction, distance, light.power.xyz * (2.0 * kPi * cap), 1.0 / (2.0 * kPi * cap));
}

// The rectangle as seen from a point at the origin: [lo, hi] in the plane at depth.
struct SeenQuad {
    vec3 x_axis;
    vec3 y_axis;
    vec3 z_axis; // from the point to the plane
    vec2 lo;
    vec2 hi;
    float depth;
    float area;
    float squared_distance; // of its centre
};

// Nearer than about five times their size rectangles are sampled by solid angle, further off by area: there the
// arcs would have few digits left, and the two differ little.
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

// Sine of the angle under which lengths are seen across a distance.
vec2 seenSine(vec2 len, float distance) { return len * inversesqrt(len * len + distance * distance); }

// Signed solid angle between x = 0 and x of the strip y.x to y.y at depth: asin(s(x) s(y.y)) - asin(s(x) s(y.x)) with
// s(l) the sine of the angle that l is seen under, here as one arc whose sine and cosine lose no digits.
float stripAngle(float x, vec2 y, float depth) {
    float squared = x * x + depth * depth;
    float lo = sqrt(squared + y.x * y.x), hi = sqrt(squared + y.y * y.y);
    float sine = abs(x) * depth * (y.y * lo - y.x * hi), cosine = depth * depth * lo * hi + x * x * y.x * y.y;
    float angle = arcOf(cosine, max(sine, 0.0));
    return x < 0.0 ? -angle : angle;
}

// Those of the rectangle's two ends in x; their difference is its solid angle.
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

// A point of the rectangle, even over solid angle. Urena, Fajardo and King, An Area-Preserving Parametrization for
// Spherical Rectangles (EGSR 2013); the strip's angle is solved for x in another form, which loses fewer digits:
// sin a = s hi and sin(a - angle) = s lo give s^2 = sin^2(angle) / (hi^2 + lo^2 - 2 hi lo cos(angle)).
vec2 solidAnglePoint(SeenQuad quad, vec2 ends, vec2 u) {
    vec2 y = vec2(quad.lo.y, quad.hi.y), seen = seenSine(y, quad.depth);
    float angle = mix(ends.x, ends.y, u.x);
    float sine = sin(0.5 * angle), cosine = cos(0.5 * angle), product = seen.x * seen.y;
    float span = product > 0.0 ? seen.y - seen.x : seen.y + seen.x, arc = product > 0.0 ? sine : cosine;
    float squared = max(span * span + 4.0 * abs(product) * arc * arc, 1e-30);
    float x = clamp(quad.depth * tangentOf(2.0 * sine * cosine * inversesqrt(squared)), quad.lo.x, quad.hi.x);
    // along y, at this x, areas on the sphere are as the sines
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
    // what an even share of the area is worth in solid angle
    float seen_area = quad.area * quad.depth / (squared * distance);
    float solid_angle = near ? max(ends.y - ends.x, 0.0) : seen_area;
    float pdf = near ? nearQuadPdf(ends) : 1.0 / max(seen_area, 1.0 / kHighestPdf);
    return LightSample(way / distance, distance, light.power.xyz * solid_angle, pdf);
}

float quadPdf(Light light, vec3 point, vec3 direction) {
    SeenQuad quad = seeQuad(light, point);
    vec2 ends = endAngles(quad);
    float cosine = abs(dot(direction, quad.z_axis));
    // depth / cosine is the distance
    float density = quad.depth * quad.depth / max(quad.area * cosine * cosine * cosine, 1e-30);
    return isNear(quad) ? nearQuadPdf(ends) : min(density, kHighestPdf);
}

// A direction from point to the light, for u in [0, 1)^2. What is behind the surface is for the caller to leave out.
LightSample sampleLight(Light light, vec3 point, vec2 u) {
    uint kind = lightKind(light);
    if (mayHaveLight(LIGHT_POINT) && kind == LIGHT_POINT) return samplePoint(light, point);
    if (mayHaveLight(LIGHT_SPOT) && kind == LIGHT_SPOT) return sampleSpot(light, point);
    if (mayHaveLight(LIGHT_SUN) && kind == LIGHT_SUN) return sampleSun(light, u);
    if (mayHaveLight(LIGHT_SPHERE) && kind == LIGHT_SPHERE) return sampleSphere(light, point, u);
    if (mayHaveLight(LIGHT_QUAD) && kind == LIGHT_QUAD) return sampleQuad(light, point, u);
    return LightSample(vec3(0.0, 0.0, 1.0), kLightAfar, vec3(0.0), 0.0);
}

// Density with which sampleLight gives a direction that meets the lamp's shape or ends in the sun's disc; 0 for lights
// without extent. Whether it does meet it is not looked at here.
float lightPdf(Light light, vec3 point, vec3 direction) {
    uint kind = lightKind(light);
    if (mayHaveLight(LIGHT_SUN) && kind == LIGHT_SUN) return sunPdf(light);
    if (mayHaveLight(LIGHT_SPHERE) && kind == LIGHT_SPHERE) {
        vec3 way = light.position.xyz - point;
        return 1.0 / (2.0 * kPi * sphereCap(dot(way, way), light.axis.w));
    }
    return mayHaveLight(LIGHT_QUAD) && kind == LIGHT_QUAD ? quadPdf(light, point, direction) : 0.0;
}

// What a ray sees that meets the lamp.
vec3 lightRadiance(Light light) {
    uint kind = lightKind(light);
    if (mayHaveLight(LIGHT_SUN) && kind == LIGHT_SUN) return sunRadiance(light);
    return kind == LIGHT_SPHERE || kind == LIGHT_QUAD ? light.power.xyz : vec3(0.0);
}

#endif
