// SPDX-License-Identifier: Apache-2.0
// Intersection of rays with shapes, the analytic surfaces. There is no branch for each kind: on lavapipe a branch costs
// as much as both sides, and on GPUs lanes with shapes of different kinds would wait for each other.
//
// The program defines loadShape(i), a macro that returns the Shape with number i; nearestShape may pass 0 even if the
// scene has no shapes. Without loadShape only the functions of a single shape are defined. If the program also defines
// kHoldsShapes, and that constant is true, heldShape(i) is used instead, with kinds known at compile time, for all
// kHeldShapes shapes.
#ifndef POINTRT_SHADERS_SHAPES_GLSL
#define POINTRT_SHADERS_SHAPES_GLSL

#extension GL_EXT_control_flow_attributes : require
#include "shaders/shared/scene_layout.h"

// A program may define which kinds it supports.
#ifndef mayHaveShape
#define mayHaveShape(kind) true
#endif

#ifndef kHoldsShapes
const bool kHoldsShapes = false;
const uint kHeldShapes = 0u;
#define heldShape(i) loadShape(i)
#endif

// The distance of a miss.
const float kNoShapeHit = 1e30;

struct ShapeHit {
    float t;    // along the ray; kNoShapeHit: a miss
    uint shape; // its number; for a miss, count
};

struct LocalRay {
    vec3 origin;
    vec3 direction; // not normalized, so that t equals that of the original ray
};

vec3 localVector(Shape shape, vec3 v) {
    return vec3(dot(shape.row_x.xyz, v), dot(shape.row_y.xyz, v), dot(shape.row_z.xyz, v));
}

vec3 localPoint(Shape shape, vec3 p) {
    return localVector(shape, p) + vec3(shape.row_x.w, shape.row_y.w, shape.row_z.w);
}

// Distance to z = 0 within the outline of the kind.
float hitFlat(uint kind, LocalRay ray) {
    float t = -ray.origin.z / ray.direction.z;
    vec2 at = ray.origin.xy + ray.direction.xy * t;
    bool on_disc = dot(at, at) <= 1.0, on_quad = max(abs(at.x), abs(at.y)) <= 1.0;
    bool inside = kind == SHAPE_PLANE || (kind == SHAPE_DISC && on_disc) || (kind == SHAPE_QUAD && on_quad);
    return inside && ray.direction.z != 0.0 ? t : kNoShapeHit;
}

// Distances at which the ray enters and leaves the box; both kNoShapeHit for a miss.
vec2 hitBox(LocalRay ray) {
    // a component of 0 would give NaN products
    vec3 direction = mix(ray.direction, vec3(1e-20), lessThan(abs(ray.direction), vec3(1e-20)));
    vec3 inverse = 1.0 / direction;
    vec3 middle = -ray.origin * inverse, half_way = abs(inverse);
    vec3 enters = middle - half_way, leaves = middle + half_way;
    float near = max(enters.x, max(enters.y, enters.z)), far = min(leaves.x, min(leaves.y, leaves.z));
    return near <= far ? vec2(near, far) : vec2(kNoShapeHit);
}

// The same for the sphere, measured from the point of the ray nearest to its centre: the difference of squares in the
// quadratic formula cancels for distant spheres (Haines et al., Ray Tracing Gems, chapter 7). The nearer root from an
// origin on the sphere is 0 up to rounding in the last bit of the radius.
vec2 hitSphere(LocalRay ray) {
    float inverse = 1.0 / dot(ray.direction, ray.direction);
    float middle = -dot(ray.origin, ray.direction) * inverse;
    vec3 nearest = ray.origin + middle * ray.direction;
    // refined from that point, since the first estimate has the rounding error of the whole distance
    float rest = -dot(nearest, ray.direction) * inverse;
    nearest += rest * ray.direction;
    float height = 1.0 - dot(nearest, nearest);
    float half_chord = sqrt(max(height, 0.0) * inverse);
    return height >= 0.0 ? middle + rest + half_chord * vec2(-1.0, 1.0) : vec2(kNoShapeHit);
}

// Distance to shape along the ray, in lengths of direction: the nearest hit at t_min or beyond, from either side;
// kNoShapeHit for a miss.
float hitShape(Shape shape, vec3 origin, vec3 direction, float t_min) {
    LocalRay ray = LocalRay(localPoint(shape, origin), localVector(shape, direction));
    uint kind = shape.kind.x;
    bool box = mayHaveShape(SHAPE_BOX) && kind == SHAPE_BOX, sphere = mayHaveShape(SHAPE_SPHERE) && kind == SHAPE_SPHERE;
    vec2 solid = box ? hitBox(ray) : (sphere ? hitSphere(ray) : vec2(kNoShapeHit));
    vec2 t = kind >= SHAPE_BOX ? solid : vec2(hitFlat(kind, ray));
    float nearest = t.x >= t_min ? t.x : t.y;
    return nearest >= t_min && nearest < kNoShapeHit ? nearest : kNoShapeHit;
}

// Unit normal at a point of shape, facing a ray with this direction. back: the ray hits the inside of a box or sphere,
// or the side of a plane, disc or quad that its z axis points away from.
vec3 shapeNormal(Shape shape, vec3 point, vec3 direction, out bool back) {
    vec3 local = localPoint(shape, point);
    vec3 size = abs(local);
    vec3 face = size.x >= max(size.y, size.z) ? vec3(1.0, 0.0, 0.0)
                                              : (size.y >= size.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0));
    uint kind = shape.kind.x;
    vec3 n = kind == SHAPE_SPHERE ? local : (kind == SHAPE_BOX ? sign(local) * face : vec3(0.0, 0.0, 1.0));
    // normals transform by the transposed rows
    vec3 normal = normalize(shape.row_x.xyz * n.x + shape.row_y.xyz * n.y + shape.row_z.xyz * n.z);
    back = dot(normal, direction) > 0.0;
    return back ? -normal : normal;
}

#ifdef loadShape

// Updates hit with a shape if its hit counts and is nearer.
void nearer(inout ShapeHit hit, bool counts, uint number, Shape shape, vec3 origin, vec3 direction, float t_min) {
    float t = hitShape(shape, origin, direction, t_min);
    bool nearer = counts && t < hit.t;
    hit.t = nearer ? t : hit.t;
    hit.shape = nearer ? number : hit.shape;
}

// The nearest of count shapes at t_min or beyond, except those with one of the skipped SHAPE_* bits.
ShapeHit nearestShapeWithout(uint skipped, uint count, vec3 origin, vec3 direction, float t_min) {
    ShapeHit hit = ShapeHit(kNoShapeHit, count);
    if (kHoldsShapes) {
        [[unroll]] for (uint i = 0u; i < kHeldShapes; i++) {
            Shape shape = heldShape(i);
            nearer(hit, (shape.kind.z & skipped) == 0u, i, shape, origin, direction, t_min);
        }
    } else {
        uint i = 0u;
        do { // finished lanes take part until all have finished: see trace.glsl
            bool going = i < count;
            Shape shape = loadShape(going ? i : 0u);
            nearer(hit, going && (shape.kind.z & skipped) == 0u, i, shape, origin, direction, t_min);
            i++;
        } while (i < count);
    }
    return hit;
}

// The nearest shapes of two rays, each with its own t_min, loading each shape once.
void nearestShapes(uint count, vec3 origin_a, vec3 direction_a, float t_min_a, vec3 origin_b, vec3 direction_b,
                   float t_min_b, out ShapeHit hit_a, out ShapeHit hit_b) {
    hit_a = ShapeHit(kNoShapeHit, count);
    hit_b = hit_a;
    if (kHoldsShapes) {
        [[unroll]] for (uint i = 0u; i < kHeldShapes; i++) {
            Shape shape = heldShape(i);
            nearer(hit_a, true, i, shape, origin_a, direction_a, t_min_a);
            nearer(hit_b, true, i, shape, origin_b, direction_b, t_min_b);
        }
    } else {
        uint i = 0u;
        do { // as in nearestShapeWithout
            bool going = i < count;
            Shape shape = loadShape(going ? i : 0u);
            nearer(hit_a, going, i, shape, origin_a, direction_a, t_min_a);
            nearer(hit_b, going, i, shape, origin_b, direction_b, t_min_b);
            i++;
        } while (i < count);
    }
}

ShapeHit nearestShape(uint count, vec3 origin, vec3 direction, float t_min) {
    return nearestShapeWithout(0u, count, origin, direction, t_min);
}

// The nearest shape for rays from the camera.
ShapeHit nearestSeenShape(uint count, vec3 origin, vec3 direction, float t_min) {
    return nearestShapeWithout(SHAPE_UNSEEN_BY_CAMERA, count, origin, direction, t_min);
}

#endif
#endif
