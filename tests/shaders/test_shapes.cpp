// SPDX-License-Identifier: Apache-2.0
// Shape intersection in the shaders against independent methods in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <string>

#include "runtime/device_scene/render_space.h"
#include "runtime/util/pack.h"
#include "shaders/shapes_probe.spv.h"
#include "tests/runtime/gpu/probe.h"

namespace pointrt {
namespace {

struct Query {
    gpu::vec4 origin, direction;
};
struct ShapesAnswer {
    gpu::vec4 normal;
    gpu::uvec4 hit;
};

constexpr double kNoHit = 1e30;
constexpr double kMinT = 1e-4; // t_min

std::vector<ShapesAnswer> intersect(const std::vector<gpu::Shape>& shapes, const std::vector<Query>& queries,
                                    std::uint32_t shape_count) {
    return runProbe<ShapesAnswer>(shapes_probe_spv, shapes, queries,
                                  {static_cast<std::uint32_t>(queries.size()), shape_count, 0, 0});
}

/// The query with its floats converted to doubles; direction need not be a unit vector.
Query query(Vec3 origin, Vec3 direction, std::uint32_t shape = 0, double t_min = kMinT) {
    return {pack(origin, t_min), pack(direction, shape)};
}

struct ShapeRandom {
    std::mt19937_64 bits;
    std::uniform_real_distribution<double> unit{-1, 1};
    double next() { return unit(bits); }
    Vec3 inCube() { return {next(), next(), next()}; }
    Vec3 direction() {
        Vec3 v = inCube();
        while (length(v) > 1 || length(v) < 1e-3) v = inCube();
        return normalize(v);
    }
};

/// A shape in general position, about half a unit in size; round shapes stay round.
ShapeDescription someShape(ShapeRandom& random, ShapeKind kind) {
    const Vec3 u = random.direction(), v = normalize(cross(u, random.direction())), w = cross(u, v);
    const double size = 0.2 + 0.5 * std::abs(random.next());
    ShapeDescription shape{kind, random.inCube(), size * u, size * v, size * w, 0, true};
    if (kind == ShapeKind::kBox || kind == ShapeKind::kQuad) shape.v = 0.3 * v + 0.2 * u; // sheared too
    if (kind != ShapeKind::kBox && kind != ShapeKind::kSphere) shape.w = w;
    return shape;
}

/// The hit in double: t, outward unit normal, and distance from an edge or silhouette relative to the shape's size.
struct Expected {
    double t = kNoHit;
    Vec3 normal;
    double margin = 1;
};

/// The parallelogram (or ellipse, or plane) center + x u + y v, by determinants.
Expected hitFlat(ShapeKind kind, Vec3 center, Vec3 u, Vec3 v, Vec3 origin, Vec3 direction) {
    const Vec3 n = cross(u, v), to = center - origin;
    const double t = dot(to, n) / dot(direction, n);
    const Vec3 at = t * direction - to;
    const double x = dot(cross(at, v), n) / dot(n, n), y = dot(cross(u, at), n) / dot(n, n);
    const double reach = kind == ShapeKind::kPlane  ? 0
                         : kind == ShapeKind::kDisc ? std::hypot(x, y)
                                                    : std::max(std::abs(x), std::abs(y));
    return {t >= kMinT && reach <= 1 ? t : kNoHit, normalize(n), std::abs(1 - reach)};
}

void keepNearer(Expected& best, const Expected& other) {
    const double margin = std::min(best.margin, other.margin);
    if (other.t < best.t) best = other;
    best.margin = margin;
}

Expected hitBox(const ShapeDescription& s, Vec3 origin, Vec3 direction) {
    Expected best;
    const Vec3 axes[3] = {s.u, s.v, s.w};
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const Vec3 a = axes[(axis + 1) % 3], b = axes[(axis + 2) % 3], out = side * axes[axis];
            Expected face = hitFlat(ShapeKind::kQuad, s.center + out, a, b, origin, direction);
            if (dot(face.normal, out) < 0) face.normal = -1 * face.normal;
            keepNearer(best, face);
        }
    return best;
}

Expected hitSphere(const ShapeDescription& s, Vec3 origin, Vec3 direction) {
    const double r = length(s.u), a = dot(direction, direction);
    const Vec3 from = origin - s.center;
    const double b = dot(from, direction), root = b * b - a * (dot(from, from) - r * r);
    Expected best;
    best.margin = std::abs(root) / (a * r * r);
    if (root < 0) return best;
    for (const double t : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a})
        if (t >= kMinT && t < best.t) best.t = t;
    best.normal = normalize(from + best.t * direction);
    return best;
}

Expected expectedHit(const ShapeDescription& s, const Query& ray) {
    const Vec3 origin = unpack(ray.origin), direction = unpack(ray.direction);
    if (s.kind == ShapeKind::kBox) return hitBox(s, origin, direction);
    if (s.kind == ShapeKind::kSphere) return hitSphere(s, origin, direction);
    Expected flat = hitFlat(s.kind, s.center, s.u, s.v, origin, direction);
    if (dot(flat.normal, s.w) < 0) flat.normal = -1 * flat.normal;
    return flat;
}

/// Compares hits of all queries except those near an edge. tolerance: absolute, or relative if t exceeds 1. Returns the
/// number of hits.
std::size_t compare(const ShapeDescription& shape, std::span<const Query> queries,
                    std::span<const ShapesAnswer> answers, double tolerance) {
    std::size_t hits = 0, wrong = 0;
    double worst_t = 0, worst_normal = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const Expected expected = expectedHit(shape, queries[i]);
        const Vec3 direction = unpack(queries[i].direction);
        const double t = answers[i].normal.w;
        const bool doubtful = expected.margin < 20 * tolerance || std::abs(expected.t - kMinT) < 1e-5;
        if (doubtful) continue;
        if ((expected.t < kNoHit) != (t < kNoHit)) wrong++;
        if (expected.t >= kNoHit || t >= kNoHit) continue;
        hits++;
        // at grazing angles an error across the ray is amplified along it
        const double slope = std::max(std::abs(dot(normalize(direction), expected.normal)), 1e-6);
        const double way = length(direction) * expected.t;
        worst_t = std::max(worst_t, std::abs(t - expected.t) * length(direction) * slope / std::max(way, 1.0));
        const bool back = dot(expected.normal, direction) > 0;
        const Vec3 normal = back ? -1 * expected.normal : expected.normal;
        const double off = length(unpack(answers[i].normal) - normal);
        if (slope > 1e-3) {
            wrong += answers[i].hit.x == (back ? 1u : 0u) ? 0 : 1;
            worst_normal = std::max(worst_normal, off * slope);
        }
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_LT(worst_t, tolerance);
    EXPECT_LT(worst_normal, 10 * tolerance); // the smallest shape is a tenth of a unit
    return hits;
}

class Shapes : public testing::TestWithParam<ShapeKind> {};

TEST_P(Shapes, AreHitAsInDouble) {
    constexpr std::size_t kShapes = 20, kRays = 5000;
    ShapeRandom random{std::mt19937_64(7), {}};
    std::vector<ShapeDescription> descriptions;
    std::vector<gpu::Shape> shapes;
    std::vector<Query> queries;
    for (std::uint32_t s = 0; s < kShapes; ++s) {
        descriptions.push_back(someShape(random, GetParam()));
        shapes.push_back(packShape({}, descriptions.back()));
        while (queries.size() < (s + 1) * kRays) {
            // half of them aimed at the shape, some from inside, directions not normalized
            const Vec3 center = descriptions.back().center;
            const Vec3 origin = (queries.size() % 4 == 0 ? 0.1 : 2.0) * random.inCube() + center;
            const Vec3 aim = center + 0.5 * random.inCube() - origin;
            const Vec3 direction = queries.size() % 2 == 0 ? random.direction() : aim;
            if (length(direction) > 0.01) queries.push_back(query(origin, direction, s));
        }
    }
    const auto answers = intersect(shapes, queries, 1);
    for (std::size_t s = 0; s < kShapes; ++s) {
        const auto part = [&](const auto& all) { return std::span(all).subspan(s * kRays, kRays); };
        EXPECT_GT(compare(descriptions[s], part(queries), part(answers), 1.5e-6), kRays / 8);
    }
}

// Rays along the axes: components of 0 cause infinite intermediate values.
TEST_P(Shapes, AreHitByRaysAlongAxes) {
    ShapeRandom random{std::mt19937_64(8), {}};
    const ShapeDescription shape{
        GetParam(), {0.25, 0.5, -0.25}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, GetParam() >= ShapeKind::kBox ? 0.5 : 1.0}, 0,
        true};
    const Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    std::vector<Query> queries;
    for (int i = 0; i < 2000; ++i)
        for (const Vec3& axis : axes) queries.push_back(query(shape.center + 2.0 * random.inCube(), axis));
    compare(shape, queries, intersect({packShape({}, shape)}, queries, 1), 1.5e-6);
}

std::string kindName(const testing::TestParamInfo<ShapeKind>& info) {
    const char* names[] = {"Plane", "Disc", "Quad", "Box", "Sphere"};
    return names[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(Kinds, Shapes,
                         testing::Values(ShapeKind::kPlane, ShapeKind::kDisc, ShapeKind::kQuad, ShapeKind::kBox,
                                         ShapeKind::kSphere),
                         kindName);

ShapeDescription sphereAt(Vec3 center, double radius) {
    return {ShapeKind::kSphere, center, {radius, 0, 0}, {0, radius, 0}, {0, 0, radius}, 0, true};
}

TEST(Spheres, ArePreciseAtADistance) {
    ShapeRandom random{std::mt19937_64(9), {}};
    const ShapeDescription sphere = sphereAt({0, 0, 0}, 0.5);
    for (const double distance : {10.0, 100.0, 1000.0}) {
        std::vector<Query> queries;
        for (int i = 0; i < 20'000; ++i) {
            const Vec3 origin = distance * random.direction();
            queries.push_back(query(origin, normalize(0.45 * random.direction() - origin)));
        }
        // a few units in the last place of the distance; the quadratic formula has an error of its square
        const double tolerance = 3e-7 * distance;
        const auto answers = intersect({packShape({}, sphere)}, queries, 1);
        EXPECT_GT(compare(sphere, queries, answers, tolerance), 10'000u) << distance;
    }
}

TEST(Spheres, IgnoreTheOriginOfRaysThatLeaveThem) {
    ShapeRandom random{std::mt19937_64(10), {}};
    const ShapeDescription sphere = sphereAt({0.3, 0.6, 0.2}, 0.25);
    std::vector<Query> inwards, outwards;
    for (int i = 0; i < 20'000; ++i) {
        const Vec3 normal = random.direction(), start = sphere.center + 0.25 * normal;
        Vec3 direction = random.direction();
        if (dot(direction, normal) > 0) direction = -1 * direction;
        if (dot(direction, normal) > -0.01) continue;
        inwards.push_back(query(start, direction));
        outwards.push_back(query(start, -1 * direction));
    }
    const auto in = intersect({packShape({}, sphere)}, inwards, 1);
    for (std::size_t i = 0; i < inwards.size(); ++i) {
        const Vec3 normal = (unpack(inwards[i].origin) - sphere.center) * 4.0;
        // a chord: twice the radius times the cosine
        ASSERT_NEAR(in[i].normal.w, -0.5 * dot(normal, unpack(inwards[i].direction)), 1e-5);
        ASSERT_EQ(in[i].hit.x, 1u) << "hit from inside";
    }
    for (const ShapesAnswer& answer : intersect({packShape({}, sphere)}, outwards, 1))
        ASSERT_GE(answer.normal.w, 1e30f);
}

TEST(Boxes, AreHitFromInside) {
    const ShapeDescription room{ShapeKind::kBox, {0, 1, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 3}, 0, true};
    const auto answers =
        intersect({packShape({}, room)},
                  {query({0, 1, 0}, {1, 0, 0}), query({0, 0.5, 0}, {0, -1, 0}), query({0, 1, 0}, {0, 0, -2}),
                   query({2, 1, 0}, {1, 0, 0}), query({2, 1, 0}, {-1, 0, 0})},
                  1);
    EXPECT_NEAR(answers[0].normal.w, 2, 1e-6);
    EXPECT_EQ(answers[0].normal.x, -1);
    EXPECT_EQ(answers[0].hit.x, 1u);
    EXPECT_NEAR(answers[1].normal.w, 0.5, 1e-6);
    EXPECT_EQ(answers[1].normal.y, 1);
    EXPECT_NEAR(answers[2].normal.w, 1.5, 1e-6) << "in lengths of the direction";
    EXPECT_EQ(answers[2].normal.z, 1);
    EXPECT_GE(answers[3].normal.w, 1e30f) << "it starts on the wall and leaves";
    EXPECT_NEAR(answers[4].normal.w, 4, 1e-5);
}

TEST(Flats, HaveTheirBackBehindTheZAxis) {
    for (const ShapeKind kind : {ShapeKind::kPlane, ShapeKind::kDisc, ShapeKind::kQuad}) {
        const ShapeDescription flat{kind, {0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0, true};
        const auto answers =
            intersect({packShape({}, flat)}, {query({0.1, 1, 0.2}, {0, -1, 0}), query({0.1, -1, 0.2}, {0, 1, 0})}, 1);
        EXPECT_EQ(answers[0].hit.x, 0u);
        EXPECT_EQ(answers[0].normal.y, 1);
        EXPECT_EQ(answers[1].hit.x, 1u);
        EXPECT_EQ(answers[1].normal.y, -1);
    }
}

TEST(NearestShape, IsTheNearestOfAll) {
    ShapeRandom random{std::mt19937_64(11), {}};
    std::vector<ShapeDescription> descriptions;
    std::vector<gpu::Shape> shapes;
    for (std::uint32_t s = 0; s < 24; ++s) {
        descriptions.push_back(someShape(random, static_cast<ShapeKind>(1 + s % 4)));
        descriptions.back().seen_by_camera = s % 3 != 0;
        shapes.push_back(packShape({}, descriptions.back()));
    }
    std::vector<Query> queries;
    for (int i = 0; i < 10'000; ++i) queries.push_back(query(2 * random.inCube(), random.direction()));
    const auto answers = intersect(shapes, queries, 24), few = intersect(shapes, queries, 5),
               none = intersect(shapes, queries, 0);
    std::size_t compared = 0;
    const auto firstOf = [&](const Query& ray, std::uint32_t count, bool all, bool& doubtful) {
        std::uint32_t first = count;
        double t = kNoHit;
        for (std::uint32_t s = 0; s < count; ++s) {
            const Expected hit = expectedHit(descriptions[s], ray);
            doubtful |=
                hit.margin < 1e-4 || std::abs(hit.t - kMinT) < 1e-5 || (hit.t < kNoHit && std::abs(hit.t - t) < 1e-5);
            if ((all || descriptions[s].seen_by_camera) && hit.t < t) t = hit.t, first = s;
        }
        return first;
    };
    for (std::size_t i = 0; i < queries.size(); ++i) {
        bool doubtful = false;
        const std::uint32_t first = firstOf(queries[i], 24, true, doubtful);
        const std::uint32_t seen = firstOf(queries[i], 24, false, doubtful);
        const std::uint32_t first_of_five = firstOf(queries[i], 5, true, doubtful);
        ASSERT_EQ(none[i].hit.y, 0u);
        ASSERT_EQ(none[i].hit.w, std::bit_cast<std::uint32_t>(1e30f));
        if (doubtful) continue;
        compared++;
        ASSERT_EQ(answers[i].hit.y, first);
        ASSERT_EQ(answers[i].hit.z, seen);
        ASSERT_EQ(few[i].hit.y, first_of_five);
        if (first == 0) {
            ASSERT_EQ(answers[i].hit.w, std::bit_cast<std::uint32_t>(answers[i].normal.w));
        }
    }
    EXPECT_GT(compared, 5'000u);
}

} // namespace
} // namespace pointrt
