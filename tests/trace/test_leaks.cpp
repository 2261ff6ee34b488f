// SPDX-License-Identifier: Apache-2.0
// Secondary rays from blended surfaces, as shaders/shade/shade_surface.comp.glsl makes them, on bodies whose surface is
// known: they must neither hit the patch they start from (acne) nor pass through a surface (leak).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "pointrt/pro.hpp"
#include "tests/support/cube_splats.h"
#include "tests/support/ray_caster.h"
#include "tests/support/splat_scenes.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {

namespace {

constexpr std::size_t kLeaksRays = 1000000; ///< secondary rays per body
constexpr double kMaxErrors = 1e-5;         ///< share of the rays
constexpr double kLeaksIndex = 1.5;

/// Signed distance in input units, negative inside.
using Distance = std::function<double(Vec3)>;

struct LeaksBody {
    std::string name;
    Splats splats;
    Distance distance;
    double edge = INFINITY; ///< half width along x and z. Rays start in the inner 0.7 of it and end at it
};

LeaksBody sphereBody() {
    return {"sphere", sphereSplats(100000, Vec3f(0, 0, 0), 1.0f), [](Vec3 p) { return length(p) - 1; }};
}

/// Around the z axis; splats are evenly distributed by the golden ratio.
LeaksBody torusBody() {
    const double major = 1, minor = 0.4;
    const std::size_t count = 100000;
    Splats splats;
    splats.oriented = true;
    const double area = 4 * std::numbers::pi * std::numbers::pi * major * minor;
    const auto radius = static_cast<float>(1.2 * std::sqrt(area / static_cast<double>(count)));
    for (std::size_t i = 0; i < count; ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        // the area up to angle v is proportional to v + minor / major sin v
        double v = 2 * std::numbers::pi * share;
        for (int step = 0; step < 20; ++step)
            v -= (v + minor / major * std::sin(v) - 2 * std::numbers::pi * share) / (1 + minor / major * std::cos(v));
        const double u = 2 * std::numbers::pi * std::fmod(static_cast<double>(i) * std::numbers::phi, 1.0);
        const Vec3d out(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v));
        const Vec3d at = minor * out + major * Vec3d(std::cos(u), std::sin(u), 0);
        splats.input_index.push_back(static_cast<std::uint32_t>(i));
        splats.positions.push_back(at.cast<float>());
        splats.normals.push_back(out.cast<float>());
        splats.radii.push_back(radius);
    }
    return {"torus", splats, [=](Vec3 p) { return std::hypot(std::hypot(p.x, p.y) - major, p.z) - minor; }};
}

/// Two sheets back to back, two radii apart. Their open rim is not tested.
LeaksBody plateBody() {
    const std::size_t side = 200;
    const float spacing = 2.0f / side, half = 1.2f * spacing;
    const Splats above = squareSplats(side, Vec3f(0, half, 0), Vec3f(0, 0, 1), Vec3f(1, 0, 0), 1.2f),
                 below = squareSplats(side, Vec3f(0, -half, 0), Vec3f(1, 0, 0), Vec3f(0, 0, 1), 1.2f);
    return {"plate", joinSplats(above, below), [=](Vec3 p) { return std::abs(p.y) - double{half}; }, 0.95};
}

class Random {
public:
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    Vec3 onSphere() {
        const double z = 1 - 2 * unit(), ring = std::sqrt(1 - z * z), angle = 2 * std::numbers::pi * unit();
        return {ring * std::cos(angle), ring * std::sin(angle), z};
    }
    /// A random direction, with a density proportional to its cosine with the unit vector n.
    Vec3 diffuse(Vec3 n) { return normalize(n + 0.9999999 * onSphere()); }

private:
    std::mt19937_64 engine_{7};
};

enum Kind { kDiffuse, kMirrored, kRefracted, kKinds };
constexpr const char* kNames[] = {"diffuse", "mirrored", "refracted"};

/// The direction of a secondary ray. kRefracted is reflected, too, if there is total internal reflection.
Vec3 scattered(Kind kind, Vec3 n, Vec3 direction, bool inside, Random& random) {
    if (kind == kDiffuse) return random.diffuse(n);
    const double cosine = -dot(n, direction), eta = inside ? kLeaksIndex : 1 / kLeaksIndex;
    const double behind = 1 - eta * eta * (1 - cosine * cosine);
    if (kind == kMirrored || behind < 0) return direction + 2 * cosine * n;
    return normalize(eta * direction + (eta * cosine - std::sqrt(behind)) * n);
}

/// A ray that left a surface.
struct Leaving {
    Ray ray;
    Kind kind = kDiffuse;
    bool inside = false; ///< whether it starts towards the inside of the body
    double radius = 0;
};

/// Computed as in offsetRayOrigin (shaders/trace/offset.glsl) and scatteredPath (shaders/shade/scattered_path.glsl).
Leaving leave(const Ray& ray, const CastHit& hit, Kind kind, Random& random) {
    const bool back = hit.back;
    Leaving leaving;
    leaving.kind = kind;
    leaving.radius = double{hit.radius};
    leaving.ray.direction = scattered(kind, hit.normal, ray.direction, back, random);
    const bool crosses = dot(hit.normal, leaving.ray.direction) < 0;
    const Vec3 side = crosses ? -1.0 * hit.normal : hit.normal;
    leaving.inside = crosses != back;
    leaving.ray.origin = ray.origin + hit.t_blended * ray.direction + 0.25 * leaving.radius * side;
    leaving.ray.self_normal = back ? -1.0 * hit.normal : hit.normal;
    leaving.ray.self_t = leaving.radius * std::min(3 / std::max(dot(side, leaving.ray.direction), 1e-6), 8.0);
    return leaving;
}

struct Errors {
    std::size_t rays = 0, acne = 0, leaks = 0;
};

/// Where a ray crosses the exact surface, in cube units.
struct Course {
    double crosses = INFINITY; ///< first distance at which it is on the other side of the surface
    double beyond = INFINITY;  ///< first distance at which it is half a radius deep on that side
};

bool isWithin(Vec3 p, double edge) { return std::abs(p.x) < edge && std::abs(p.z) < edge; }

class Geometry {
public:
    Geometry(const LeaksBody& body, const pro_info& info) : body_(body), info_(info) {}

    Vec3 input(Vec3 cube) const { return Vec3{info_.origin[0], info_.origin[1], info_.origin[2]} + info_.scale * cube; }

    double side(const Leaving& leaving, double t) const {
        const double d = body_.distance(input(leaving.ray.origin + t * leaving.ray.direction)) / info_.scale;
        return leaving.inside ? -d : d;
    }

    /// Follows the ray up to this distance.
    Course follow(const Leaving& leaving, double end) const {
        Course course;
        for (double t = 0; t < end;) {
            if (!isWithin(input(leaving.ray.origin + t * leaving.ray.direction), body_.edge)) break;
            const double d = side(leaving, t);
            if (d < 0 && std::isinf(course.crosses)) course.crosses = t;
            if (d < -0.5 * leaving.radius) {
                course.beyond = t;
                break;
            }
            // too small a step to get half a radius deep and out again
            t += std::max(std::abs(d), 0.25 * leaving.radius);
        }
        return course;
    }

private:
    const LeaksBody& body_;
    const pro_info& info_;
};

/// Hits within this many radii may be on the patch that the ray leaves: 1.5 times the largest self-intersection
/// distance.
constexpr double kPatch = 12;
/// Distance along the ray, in radii, by which a protruding disc may move a hit.
constexpr double kSlack = 4;
/// Beyond every body here, in cube units.
constexpr double kFar = 4;

void judge(const Leaving& leaving, const CastHit& hit, const Course& course, double slack, Errors& errors) {
    ++errors.rays;
    errors.acne += hit.hit() && hit.t_flat < kPatch * leaving.radius && course.crosses > hit.t_flat + slack;
    errors.leaks += std::isfinite(course.beyond) && (!hit.hit() || hit.t_flat > course.beyond + slack);
}

/// A secondary ray from each hit in the inner part of the body, of each kind in turn.
std::vector<Leaving> leaveAll(const LeaksBody& body, const Geometry& geometry, std::span<const Ray> rays,
                              const std::vector<CastHit>& hits, Random& random) {
    std::vector<Leaving> all;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].hit()) continue;
        if (!isWithin(geometry.input(rays[i].origin + hits[i].t_blended * rays[i].direction), 0.7 * body.edge))
            continue;
        all.push_back(leave(rays[i], hits[i], static_cast<Kind>(all.size() % kKinds), random));
    }
    return all;
}

/// Rays from outside to random splats, in uniformly distributed directions: many graze the surface.
std::vector<Ray> aimedRays(const std::vector<CubeSplat>& splats, std::size_t count, Random& random) {
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const CubeSplat& splat = splats[static_cast<std::size_t>(random.unit() * static_cast<double>(splats.size()))];
        const Vec3 d = random.onSphere();
        rays.push_back({splat.center + splat.radius * random.unit() * random.onSphere() - 2 * d, d, {}, 0});
    }
    return rays;
}

std::vector<Ray> raysOf(const std::vector<Leaving>& all) {
    std::vector<Ray> rays;
    for (const Leaving& each : all) rays.push_back(each.ray);
    return rays;
}

/// Traces the rays and counts errors by kind and by the side on which the rays start.
std::vector<CastHit> judgeAll(RayCaster& caster, const Geometry& geometry, const std::vector<Leaving>& all,
                              Errors (&errors)[2][kKinds]) {
    const std::vector<Ray> rays = raysOf(all);
    std::vector<CastHit> hits = caster.cast(rays);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double slack = kSlack * all[i].radius, end = hits[i].hit() ? hits[i].t_flat + 2 * slack : kFar;
        judge(all[i], hits[i], geometry.follow(all[i], end), slack, errors[all[i].inside][all[i].kind]);
    }
    return hits;
}

void checkBody(const LeaksBody& body) {
    const std::string path = temporaryPath(body.name + ".pro");
    writeScene(path, body.splats, {});
    const pro_info info = ProFile(path).info();
    const std::vector<CubeSplat> splats = loadCubeSplats(path);
    RayCaster caster(path);
    std::remove(path.c_str());
    const Geometry geometry(body, info);
    Random random;
    Errors errors[2][kKinds];
    std::size_t rays = 0;
    while (rays < kLeaksRays) {
        const std::vector<Ray> primary = aimedRays(splats, 200000, random);
        const std::vector<Leaving> first = leaveAll(body, geometry, primary, caster.cast(primary), random);
        const std::vector<CastHit> hits = judgeAll(caster, geometry, first, errors);
        const std::vector<Ray> first_rays = raysOf(first);
        const std::vector<Leaving> second = leaveAll(body, geometry, first_rays, hits, random);
        judgeAll(caster, geometry, second, errors);
        rays += first.size() + second.size();
        ASSERT_GT(first.size(), primary.size() / 4);
    }
    std::size_t acne = 0, leaks = 0;
    for (const bool inside : {false, true})
        for (int kind = 0; kind < kKinds; ++kind) {
            const Errors& sum = errors[inside][kind];
            std::printf("%s, %s, %s: %zu rays, %zu on their own patch, %zu through\n", body.name.c_str(),
                        inside ? "inwards" : "outwards", kNames[kind], sum.rays, sum.acne, sum.leaks);
            acne += sum.acne;
            leaks += sum.leaks;
        }
    std::printf("%s: %.1e on their own patch, %.1e through\n", body.name.c_str(),
                static_cast<double>(acne) / static_cast<double>(rays),
                static_cast<double>(leaks) / static_cast<double>(rays));
    EXPECT_LE(static_cast<double>(acne + leaks), kMaxErrors * static_cast<double>(rays));
}

TEST(Leaks, ClosedSphereHasNoLeaksOrAcne) { checkBody(sphereBody()); }
TEST(Leaks, TorusHasNoLeaksOrAcne) { checkBody(torusBody()); }
TEST(Leaks, ThinPlateHasNoLeaksOrAcne) { checkBody(plateBody()); }

} // namespace

} // namespace pointrt::test
