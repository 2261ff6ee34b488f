// SPDX-License-Identifier: Apache-2.0
// Surfaces do not shade themselves, with any scatter and orientation of normals.
#include <random>

#include "tests/runtime/studies/study_scenes.h"
#include "tests/support/says.h"

namespace pointrt::test {
namespace {

constexpr double kInside = 0.15; // cube units: only points this far from the rim of the ground are checked

/// Level ground whose discs scatter by this many radii and tilt by up to lean_deg; some normals are flipped.
std::vector<pro_splat> roughGround(double scatter, double lean_deg, double turned) {
    std::mt19937 random(1);
    std::normal_distribution<double> gauss;
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<pro_splat> splats = planeSplats(100, 0.5f);
    for (pro_splat& splat : splats) {
        splat.position[2] += static_cast<float>(scatter * gauss(random) * static_cast<double>(splat.radius));
        const double lean = std::tan(lean_deg * std::numbers::pi / 180) * unit(random);
        const double angle = 2 * std::numbers::pi * unit(random), size = std::hypot(1, lean);
        const double side = unit(random) < turned ? -1 : 1;
        splat.normal[0] = static_cast<float>(side * lean * std::cos(angle) / size);
        splat.normal[1] = static_cast<float>(side * lean * std::sin(angle) / size);
        splat.normal[2] = static_cast<float>(side / size);
    }
    return splats;
}

struct Share {
    double lit = 0;
    std::size_t points = 0;
};

class Surface : public Study {
protected:
    /// Statistics of the points away from the rim.
    Share litShare(const std::vector<pro_splat>& splats, std::array<double, 3> light, Sides sides) {
        const std::string path = scan("ground.pro", splats);
        const TraceScene scene(device, {path});
        const ScanPoints points = scanPoints(path);
        std::vector<double> lit(points.radii.size());
        sumLights(scene, points.rows(), lightFrom(light), {.sides = sides}, lit);
        const GridPlace place;
        Share share;
        for (std::size_t i = 0; i < lit.size(); ++i) {
            const double x = (points.positions[3 * i] - place.origin[0]) / place.edge,
                         y = (points.positions[3 * i + 1] - place.origin[1]) / place.edge;
            if (std::max(std::abs(x - 0.5), std::abs(y - 0.5)) > 0.4 - kInside) continue;
            share.lit += lit[i];
            ++share.points;
        }
        share.lit /= static_cast<double>(share.points);
        return share;
    }
};

TEST_F(Surface, GroundDoesNotShadeItself) {
    for (const double elevation : {85.0, 40.0, 15.0, 6.0}) {
        EXPECT_EQ(litShare(roughGround(0, 0, 0), towards(elevation, 100), Sides::kFront).lit, 1) << elevation;
        // ground this rough casts real shadows if the sun is lower than its slopes
        EXPECT_GT(litShare(roughGround(0.2, 8, 0), towards(elevation, 100), Sides::kBoth).lit,
                  elevation > 8 ? 0.999 : 0.95)
            << elevation;
    }
    EXPECT_EQ(litShare(roughGround(0, 0, 0), towards(2, 100), Sides::kFront).lit, 1);
}

TEST_F(Surface, UncleanedScatterDoesNotShadeGroundAtLowSun) {
    // a bake without cleaning leaves points a third of a radius off the ground, with nearly level normals
    for (const double elevation : {10.0, 6.0, 4.0})
        EXPECT_GT(litShare(roughGround(0.33, 1.5, 0), towards(elevation, 100), Sides::kFront).lit, 0.99) << elevation;
}

TEST_F(Surface, FlippedNormalsMatterForOneSidedPoints) {
    const std::vector<pro_splat> ground = roughGround(0.1, 5, 0.5);
    EXPECT_GT(litShare(ground, towards(40, 100), Sides::kBoth).lit, 0.999);
    EXPECT_NEAR(litShare(ground, towards(40, 100), Sides::kFront).lit, 0.5, 0.03);
    EXPECT_EQ(litShare(roughGround(0, 0, 1), towards(40, 100), Sides::kFront).lit, 0);
}

TEST_F(Surface, KnownNoiseExtendsTheSelfIntersectionDistance) {
    std::vector<pro_splat> splats = roughGround(0.9, 10, 0);
    const std::string path = scan("noisy.pro", splats);
    const TraceScene scene(device, {path});
    ScanPoints points = scanPoints(path);
    const auto share = [&] {
        std::vector<double> lit(points.radii.size());
        sumLights(scene, points.rows(), lightFrom(towards(25, 30)), {}, lit);
        double sum = 0;
        for (const double each : lit) sum += each;
        return sum / static_cast<double>(lit.size());
    };
    const double without = share();
    points.noise.assign(points.radii.size(), 0.9f * points.radii[0]);
    EXPECT_GT(share(), 0.999);
    EXPECT_LT(without, 0.99);
}

TEST_F(Surface, ABallIsLitOnOneHalf) {
    const std::string path = scan("ball.pro", sphereSplats(4000, 0.3f));
    const TraceScene scene(device, {path});
    const ScanPoints points = scanPoints(path);
    const auto light = towards(35, 250);
    for (const Sides sides : {Sides::kFront, Sides::kBoth}) {
        std::vector<double> lit(points.radii.size());
        sumLights(scene, points.rows(), lightFrom(light), {.sides = sides}, lit);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < lit.size(); ++i) {
            const float* n = points.normals.data() + 3 * i;
            const double cosine = n[0] * light[0] + n[1] * light[1] + n[2] * light[2];
            // with both sides, points within 8 radii beyond the terminator are lit
            const double reach = sides == Sides::kFront ? 0.01 : 8.0 * points.radii[i] / (0.3 * 128);
            if (std::abs(cosine) > reach) wrong += (lit[i] > 0) != (cosine > 0);
        }
        EXPECT_EQ(wrong, 0u) << static_cast<int>(sides);
    }
}

TEST_F(Surface, SkyViewIsOneInTheOpenAndTheFormulaInABasin) {
    // a round basin: a wall of height 0.2 at distance 0.2, so the horizon is at 45 degrees
    std::vector<pro_splat> splats;
    const double radius = 0.2, height = 0.2, spacing = 0.004;
    for (double z = spacing / 2; z < height; z += spacing)
        for (double angle = 0; angle < 2 * std::numbers::pi; angle += spacing / radius) {
            const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
            splats.push_back({{0.5f + 0.2f * c, 0.5f + 0.2f * s, static_cast<float>(0.25 + z)},
                              {-c, -s, 0},
                              static_cast<float>(0.8 * spacing),
                              {},
                              0});
        }
    const std::string path = scan("basin.pro", splats);
    const TraceScene scene(device, {path});
    const GridPlace place;
    const std::vector<double> places{place.origin[0] + 64, place.origin[1] + 64, place.origin[2] + 0.25 * place.edge,
                                     place.origin[0] + 64, place.origin[1] + 64, place.origin[2] + 0.9 * place.edge};
    std::vector<double> sky(2);
    sumLights(scene, {places}, skyLights(4096, studyFrame(path, {})), {}, sky);
    EXPECT_NEAR(sky[0], 0.5, 0.01) << "the cosine of 45 degrees, squared";
    EXPECT_NEAR(sky[1], 1, 1e-9);
}

TEST_F(Surface, InvalidPointsAreNamedByTheirIndex) {
    const TraceScene scene(device, {scan("ground.pro", planeSplats(10, 0.5f))});
    std::vector<double> positions{0, 0, 0, std::nan(""), 0, 0}, sums(2);
    const Lights light = lightFrom({0, 0, 1});
    const auto reason = [&](const StudyPoints& points, const StudyRules& rules) -> std::string {
        try {
            sumLights(scene, points, light, rules, sums);
        } catch (const TraceError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_SAYS(reason({positions}, {}), "point 1: *position *finite");
    positions[3] = 1;
    const std::vector<float> one(1), six(6);
    EXPECT_EQ(reason({positions}, {}), "");
    EXPECT_SAYS(reason({positions, one}, {}), "normals *row");
    EXPECT_SAYS(reason({positions, six, one}, {}), "radii *row");
    EXPECT_SAYS(reason({positions}, {.radius = -1}), "*radius *0");
}

} // namespace
} // namespace pointrt::test
