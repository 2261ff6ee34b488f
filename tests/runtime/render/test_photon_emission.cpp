// SPDX-License-Identifier: Apache-2.0
// Photons emitted by lights: their flux and their directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

#include "runtime/device_scene/render_space.h"
#include "runtime/render/photon_emission.h"

namespace pointrt {
namespace {

using std::numbers::pi;

constexpr std::uint32_t kCount = 1u << 15;
constexpr RenderSphere kSceneSphere{{0, 0, 0}, 5};
const PhotonTarget kBall{{1, -2, 3}, 0.75, 7};

Vec3 vecOf(const gpu::vec3& v) { return {v.x, v.y, v.z}; }

/// Checks properties that photons of any light have.
void expectValid(const std::vector<gpu::PathState>& paths, const PhotonTarget& target) {
    for (const gpu::PathState& path : paths) {
        const Vec3 direction = vecOf(path.direction), way = target.center - vecOf(path.origin);
        ASSERT_NEAR(length(direction), 1, 1e-6);
        ASSERT_LT(length(cross(way, direction)), target.radius * (1 + 1e-4)) << "misses the target";
        ASSERT_GT(dot(way, direction), -target.radius) << "leaves the target behind";
        ASSERT_EQ(path.target, target.code);
        ASSERT_EQ(path.bits, NO_OWNER << PATH_OWNER_SHIFT);
        ASSERT_TRUE(std::isfinite(path.throughput.x) && path.throughput.x > 0);
        // all lights here have this colour
        ASSERT_NEAR(path.throughput.y / path.throughput.x, 0.5, 1e-6);
        ASSERT_NEAR(path.throughput.z / path.throughput.x, 0.25, 1e-6);
    }
}

/// All paths of a map.
std::vector<gpu::PathState> emitPhotons(std::span<const gpu::Light> lights, const std::vector<PhotonTarget>& targets,
                                        RenderSphere scene, std::uint32_t count, PhotonSequence turn = {}) {
    return PhotonEmission(lights, targets, scene, count, turn).next(2 * count);
}

double fluxOf(const std::vector<gpu::PathState>& paths) {
    double sum = 0;
    for (const gpu::PathState& path : paths) sum += path.throughput.x;
    return sum;
}

double emittedFlux(const LightDescription& light, const PhotonTarget& target) {
    const std::vector<gpu::Light> rows{packLight({}, light)};
    const std::vector<gpu::PathState> paths = emitPhotons(rows, std::vector{target}, kSceneSphere, kCount);
    expectValid(paths, target);
    return fluxOf(paths);
}

void expectFlux(const LightDescription& light, const PhotonTarget& target, double expected) {
    EXPECT_NEAR(emittedFlux(light, target) / expected, 1, 0.003) << expected;
}

constexpr Color kColor{2, 1, 0.5f};

/// 1 minus the cosine of the half angle under which target is seen.
double capOf(const PhotonTarget& target, Vec3 from) {
    const double sine = target.radius / length(target.center - from);
    return 1 - std::sqrt(1 - sine * sine);
}

/// The midpoint rule with n times n cells of the unit square.
double integral(int n, const std::function<double(double, double)>& f) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) sum += f((i + 0.5) / n, (j + 0.5) / n);
    return sum / n / n;
}

/// The integral over all directions.
double overSphere(int n, const std::function<double(Vec3)>& f) {
    return 4 * pi * integral(n, [&](double u, double v) {
               const double z = 1 - 2 * u, ring = std::sqrt(1 - z * z);
               return f({ring * std::cos(2 * pi * v), ring * std::sin(2 * pi * v), z});
           });
}

TEST(PhotonEmission, PointLightsEmitTheirFlux) {
    const PointLight light{{4, 0, 1}, kColor};
    expectFlux(light, kBall, 2 * 2 * pi * capOf(kBall, light.position));
    // from inside the target, and from its centre
    for (const Vec3 inside : {Vec3{1.2, -1.9, 2.7}, kBall.center})
        expectFlux(PointLight{inside, kColor}, kBall, 2 * 4 * pi);
}

TEST(PhotonEmission, SpotLightsEmitTheirFlux) {
    const Vec3 from{4, 0, 1};
    const auto flux = [&](const SpotLight& light, const PhotonTarget& target) {
        const double outer = std::cos(light.outer_deg * pi / 180), inner = std::cos(light.inner_deg * pi / 180);
        return overSphere(4000, [&](Vec3 d) {
            const Vec3 way = target.center - light.position;
            const bool within = length(way) < target.radius;
            if (!within && dot(d, normalize(way)) < 1 - capOf(target, light.position)) return 0.0;
            const double x = std::clamp((dot(d, light.direction) - outer) / (inner - outer), 0.0, 1.0);
            return 2 * x * x * (3 - 2 * x);
        });
    };
    const Vec3 aim = normalize(kBall.center - from);
    // cones: around the ball, inside its silhouette, half covered by it, and starting inside it
    for (const SpotLight& light :
         {SpotLight{from, aim, 30, 25, kColor}, SpotLight{from, aim, 5, 3, kColor},
          SpotLight{from, normalize(aim + Vec3{0, 0.2, 0}), 10, 4, kColor}, SpotLight{{1.2, -2, 3}, aim, 8, 4, kColor}})
        expectFlux(light, kBall, flux(light, kBall));
    // a very narrow cone inside the ball: directions sampled over the whole sphere would hardly be in it
    const double middle = std::cos(1.99 / 2 * pi / 180);
    expectFlux(SpotLight{{1.2, -2, 3}, aim, 1, 0.99, kColor}, kBall, 2 * 2 * pi * (1 - middle));
    EXPECT_EQ(emittedFlux(SpotLight{from, -1 * aim, 30, 25, kColor}, kBall), 0) << "turned away";
}

/// The area that two discs with centres d apart share.
double sharedArea(double r, double s, double d) {
    if (d >= r + s) return 0;
    if (d <= std::abs(r - s)) return pi * std::min(r, s) * std::min(r, s);
    const double a = (d * d + r * r - s * s) / (2 * d), b = d - a;
    return r * r * std::acos(a / r) - a * std::sqrt(r * r - a * a) + s * s * std::acos(b / s) -
           b * std::sqrt(s * s - b * b);
}

/// The measure of lines through two separate balls: the area shared by their shadows, integrated over directions.
double linesBetween(double r, double s, double distance) {
    const int n = 100'000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double angle = pi / 2 * (i + 0.5) / n;
        sum += sharedArea(r, s, distance * std::sin(angle)) * std::sin(angle);
    }
    return 2 * pi * sum * (pi / 2) / n;
}

TEST(PhotonEmission, SphereLightsEmitTheirFlux) {
    for (const SphereLight& light : {SphereLight{{4, 0, 1}, 0.5, kColor}, SphereLight{{2, -2, 3.8}, 0.5, kColor},
                                     SphereLight{{31, -2, 3}, 29, kColor}, SphereLight{{500, 0, 0}, 3, kColor}})
        expectFlux(light, kBall, 2 * linesBetween(light.radius, kBall.radius, length(light.center - kBall.center)));
    // a lamp inside the target gives it all of its light; a target inside a lamp gets none, because lamps shine
    // outwards
    expectFlux(SphereLight{{1.1, -2, 3.1}, 0.2, kColor}, kBall, 2 * pi * 4 * pi * 0.2 * 0.2);
    EXPECT_EQ(emittedFlux(SphereLight{{1, -2, 3.5}, 2, kColor}, kBall), 0);
}

TEST(PhotonEmission, QuadLightsEmitTheirFlux) {
    const QuadLight above{{0.5, 2, 2}, {0, 0, 1.5}, {0.8, 0, 0}, kColor};
    const auto pointOf = [](const QuadLight& light, double u, double v) {
        return light.center + (2 * u - 1) * light.u + (2 * v - 1) * light.v;
    };
    const auto area = [](const QuadLight& light) { return 4 * length(light.u) * length(light.v); };
    // a ball above the lamp's horizon: its projected solid angle is pi sin^2 times the cosine to its centre
    expectFlux(above, kBall, 2 * area(above) * integral(400, [&](double u, double v) {
                                 const Vec3 way = kBall.center - pointOf(above, u, v);
                                 const double squared = dot(way, way);
                                 return pi * kBall.radius * kBall.radius / squared * std::abs(way.y) /
                                        std::sqrt(squared);
                             }));
    // a ball across the lamp's plane: both sides shine
    const QuadLight level{{3, -2.2, 3}, {0, 0, 0.5}, {0.5, 0, 0}, kColor};
    expectFlux(level, kBall, 2 * area(level) * integral(12, [&](double u, double v) {
                                 const Vec3 from = pointOf(level, u, v), axis = normalize(kBall.center - from);
                                 const double cosine = 1 - capOf(kBall, from);
                                 return overSphere(500,
                                                   [&](Vec3 d) { return dot(d, axis) > cosine ? std::abs(d.y) : 0.0; });
                             }));
    // a lamp inside the target
    const QuadLight inside{kBall.center, {0.3, 0, 0}, {0, 0.1, 0}, kColor};
    expectFlux(inside, kBall, 2 * area(inside) * 2 * pi);
}

TEST(PhotonEmission, DiscLightsEmitTheirFlux) {
    const auto ringPoint = [](const DiscLight& light, double u, double v) {
        const double ring = light.radius * std::sqrt(u), angle = 2 * pi * v;
        return light.center + ring * Vec3{std::cos(angle), 0, std::sin(angle)};
    };
    const DiscLight above{{0.5, 2, 2}, {0, -1, 0}, 1.2, kColor};
    expectFlux(above, kBall, 2 * pi * 1.2 * 1.2 * integral(400, [&](double u, double v) {
                                 const Vec3 way = kBall.center - ringPoint(above, u, v);
                                 const double squared = dot(way, way);
                                 return pi * kBall.radius * kBall.radius / squared * std::abs(way.y) /
                                        std::sqrt(squared);
                             }));
    // both sides shine
    const DiscLight below{{0.5, -6, 2}, {0, -1, 0}, 1.2, kColor}, turned{{0.5, -6, 2}, {0, 1, 0}, 1.2, kColor};
    EXPECT_NEAR(emittedFlux(below, kBall) / emittedFlux(turned, kBall), 1, 0.003);
    // a lamp inside the target
    const DiscLight inside{kBall.center, {0, 1, 0}, 0.2, kColor};
    expectFlux(inside, kBall, 2 * pi * 0.2 * 0.2 * 2 * pi);
}

TEST(PhotonEmission, SunLightsEmitTheirFlux) {
    const Vec3 towards = normalize(Vec3{1, 2, -1});
    for (const double radius_deg : {0.0, 0.2665, 10.0, 45.0}) {
        // radiance is irradiance / (pi sin^2); the flux is radiance times the sun's solid angle and the ball's shadow
        const double cosine = std::cos(radius_deg * pi / 180);
        const std::vector<gpu::Light> rows{packLight({}, SunLight{towards, radius_deg, kColor})};
        const std::vector<gpu::PathState> paths = emitPhotons(rows, std::vector{kBall}, kSceneSphere, kCount);
        expectValid(paths, kBall);
        EXPECT_NEAR(fluxOf(paths) / (2 * 2 / (1 + cosine) * pi * kBall.radius * kBall.radius), 1, 0.003);
        for (const gpu::PathState& path : paths) {
            ASSERT_GT(length(vecOf(path.origin) - kSceneSphere.center), kSceneSphere.radius)
                << "photons must start outside the scene";
            ASSERT_GE(-dot(vecOf(path.direction), towards), cosine - 1e-6);
        }
    }
}

TEST(PhotonEmission, IsEvenOverTheTarget) {
    // the flux on the halves of the ball's silhouette as seen from the light
    const PointLight light{{4, 0, 1}, kColor};
    const Vec3 axis = normalize(kBall.center - light.position), side = normalize(cross(axis, {0, 1, 0})),
               up = cross(side, axis);
    double left = 0, low = 0, all = 0;
    for (const gpu::PathState& path :
         emitPhotons(std::vector{packLight({}, light)}, std::vector{kBall}, kSceneSphere, kCount)) {
        const Vec3 d = vecOf(path.direction);
        left += dot(d, side) < 0 ? path.throughput.x : 0;
        low += dot(d, up) < 0 ? path.throughput.x : 0;
        all += path.throughput.x;
    }
    EXPECT_NEAR(left / all, 0.5, 0.003);
    EXPECT_NEAR(low / all, 0.5, 0.003);
}

TEST(PhotonEmission, SharesPhotonsByFlux) {
    // two lights and two targets: each pair has its whole flux, and a share of the photons in proportion to that
    const std::vector<LightDescription> lights{PointLight{{4, 0, 1}, kColor}, PointLight{{-3, 4, 0}, {20, 10, 5}}};
    const std::vector<PhotonTarget> targets{kBall, {{-2, 0, 0}, 0.5, OWNER_SHAPES | 3u << PHOTON_SHAPE_SHIFT}};
    std::vector<gpu::Light> rows;
    for (const LightDescription& light : lights) rows.push_back(packLight({}, light));
    const std::vector<gpu::PathState> paths = emitPhotons(rows, targets, kSceneSphere, kCount);
    EXPECT_NEAR(static_cast<double>(paths.size()), kCount, 8);
    double total = 0;
    std::vector<double> flux(4), photons(4);
    for (const gpu::PathState& path : paths) {
        const std::size_t target = path.target == targets[1].code;
        const std::size_t pair = 2 * (path.origin.x < 0) + target;
        flux[pair] += path.throughput.x;
        ++photons[pair];
        total += path.throughput.x;
    }
    for (std::size_t pair = 0; pair < 4; ++pair) {
        const auto& light = std::get<PointLight>(lights[pair / 2]);
        const double expected = light.intensity[0] * 2 * pi * capOf(targets[pair % 2], light.position);
        EXPECT_NEAR(flux[pair] / expected, 1, 0.003) << pair;
        EXPECT_NEAR(photons[pair] / static_cast<double>(paths.size()), expected / total, 0.002) << pair;
    }
}

TEST(PhotonEmission, IsDeterministic) {
    const std::vector<gpu::Light> lights{packLight({}, SphereLight{{4, 0, 1}, 0.5, kColor}),
                                         packLight({}, SunLight{{0, 1, 0}, 3, kColor})};
    const auto once = emitPhotons(lights, std::vector{kBall}, kSceneSphere, 1000);
    const auto again = emitPhotons(lights, std::vector{kBall}, kSceneSphere, 1000);
    ASSERT_EQ(once.size(), again.size());
    EXPECT_EQ(std::memcmp(once.data(), again.data(), once.size() * sizeof once[0]), 0);
    EXPECT_NE(std::memcmp(&once[0].direction, &once[1].direction, sizeof(gpu::vec4)), 0);
}

/// Root mean square of the relative error of the number of photons in a cell, over cells of equal solid angle.
double unevenness(const std::vector<gpu::PathState>& paths, Vec3 from) {
    constexpr int kCells = 24;
    const Frame frame(normalize(kBall.center - from));
    const double cap = capOf(kBall, from);
    std::vector<double> counts(kCells * kCells);
    for (const gpu::PathState& path : paths) {
        const Vec3 d = vecOf(path.direction);
        const double turn = std::atan2(dot(d, frame.t), dot(d, frame.s)) / (2 * pi) + 0.5;
        const auto cell = [](double x) { return std::clamp(static_cast<int>(x * kCells), 0, kCells - 1); };
        ++counts[static_cast<std::size_t>(cell((1 - dot(d, frame.n)) / cap) * kCells + cell(turn))];
    }
    double sum = 0;
    for (const double count : counts)
        sum += std::pow(count * kCells * kCells / static_cast<double>(paths.size()) - 1, 2);
    return std::sqrt(sum) / kCells;
}

TEST(PhotonEmission, MapsArePartsOfOneEvenSequence) {
    const PointLight light{{4, 0, 1}, kColor};
    const std::vector<gpu::Light> lights{packLight({}, light)};
    std::vector<gpu::PathState> all;
    double one = 0;
    for (std::uint32_t map = 0; map < 16; ++map) {
        const auto paths = emitPhotons(lights, {kBall}, kSceneSphere, kCount, {map, 0});
        EXPECT_NEAR(fluxOf(paths) / (2 * 2 * pi * capOf(kBall, light.position)), 1, 0.003) << map;
        all.insert(all.end(), paths.begin(), paths.end());
        if (map == 0) one = unevenness(paths, light.position);
    }
    // sixteen independent maps are a quarter as uneven as one; sixteen equal ones would be as uneven
    std::printf("unevenness of one map %.5f, of sixteen %.5f\n", one, unevenness(all, light.position));
    EXPECT_LT(unevenness(all, light.position), one / 8);
    const auto at_once = emitPhotons(lights, {kBall}, kSceneSphere, 16 * kCount);
    ASSERT_EQ(at_once.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        ASSERT_LT(length(vecOf(at_once[i].direction) - vecOf(all[i].direction)), 1e-5) << i;
}

TEST(PhotonEmission, DiffersBySeed) {
    const std::vector<gpu::Light> lights{packLight({}, PointLight{{4, 0, 1}, kColor})};
    const auto first = emitPhotons(lights, {kBall}, kSceneSphere, 1000),
               other = emitPhotons(lights, {kBall}, kSceneSphere, 1000, {0, 1}),
               third = emitPhotons(lights, {kBall}, kSceneSphere, 1000, {0, 2});
    for (std::size_t i = 0; i < first.size(); ++i) {
        ASSERT_GT(length(vecOf(first[i].direction) - vecOf(other[i].direction)), 1e-6);
        ASSERT_GT(length(vecOf(third[i].direction) - vecOf(other[i].direction)), 1e-6);
    }
}

TEST(PhotonEmission, IsEmptyWithoutLightsOrTargets) {
    const gpu::Light sky{{0, 0, 0, LIGHT_SKY}, {}, {}, {}, {}}, lamp = packLight({}, PointLight{{4, 0, 1}, kColor});
    EXPECT_TRUE(emitPhotons({}, std::vector{kBall}, kSceneSphere, kCount).empty());
    EXPECT_TRUE(emitPhotons(std::vector{lamp}, {}, kSceneSphere, kCount).empty());
    EXPECT_TRUE(emitPhotons(std::vector{sky}, std::vector{kBall}, kSceneSphere, kCount).empty());
    EXPECT_TRUE(emitPhotons(std::vector{packLight({}, PointLight{{4, 0, 1}, {0, 0, 0}})}, std::vector{kBall},
                            kSceneSphere, kCount)
                    .empty());
    EXPECT_TRUE(
        emitPhotons(std::vector{lamp}, std::vector{PhotonTarget{{0, 0, 0}, 0, 0}}, kSceneSphere, kCount).empty());
}

} // namespace
} // namespace pointrt
