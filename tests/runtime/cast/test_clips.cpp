// SPDX-License-Identifier: Apache-2.0
// Rays through a clipped scene have the hits of rays through the whole scene that start where they enter the kept part;
// hits beyond its end do not count.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"
#include "runtime/scene/clip.h"
#include "tests/gaussians/nasty_gaussians.h"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/runtime/rays/set_scenes.h"
#include "tests/support/splat_scenes.h"
#include "tests/support/temporary_folder.h"
#include "tests/trace/gaussian_file.h"

namespace pointrt::test {
namespace {

constexpr double kNoHitDistance = std::numeric_limits<double>::infinity();
constexpr std::size_t kClippedRays = 4000;

/// Rays from points around the origin, some near it, towards other points; directions of unit length.
std::vector<double> clippedRays(double size) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    std::vector<double> rays;
    for (std::size_t i = 0; i < kClippedRays; ++i) {
        const Vec3 from = (i % 3 == 0 ? 0.5 : 3.0) * size * Vec3{normal(random), normal(random), normal(random)};
        const Vec3 to = 0.5 * size * Vec3{normal(random), normal(random), normal(random)};
        addRay(rays, from, normalize(to - from));
    }
    return rays;
}

struct Interval {
    double from = 0, to = kNoHitDistance;
};

/// The part of ray i that is kept.
Interval keptPart(const std::vector<HalfSpace>& kept, const std::vector<double>& rays, std::size_t i) {
    const Vec3 origin{rays[6 * i], rays[6 * i + 1], rays[6 * i + 2]};
    const Vec3 direction{rays[6 * i + 3], rays[6 * i + 4], rays[6 * i + 5]};
    Interval part;
    for (const HalfSpace& each : kept) {
        const double slope = dot(each.normal, direction), t = dot(each.normal, each.point - origin) / slope;
        if (slope > 0) part.from = std::max(part.from, t);
        if (slope < 0) part.to = std::min(part.to, t);
    }
    return part;
}

std::vector<double> distancesOf(const TraceScene& scene, const std::vector<double>& rays) {
    std::vector<double> t(rays.size() / 6);
    scene.castRays(std::span<const double>(rays), {}, {.t_hit = t});
    return t;
}

/// The expected hits of a clipped scene, from those of the whole scene.
std::vector<double> clippedDistances(const TraceScene& whole, const std::vector<HalfSpace>& kept,
                                     const std::vector<double>& rays) {
    std::vector<double> moved = rays;
    for (std::size_t i = 0; i < kClippedRays; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            moved[6 * i + axis] += keptPart(kept, rays, i).from * rays[6 * i + 3 + axis];
    std::vector<double> t = distancesOf(whole, moved);
    for (std::size_t i = 0; i < kClippedRays; ++i) {
        const Interval part = keptPart(kept, rays, i);
        t[i] += part.from;
        if (!(t[i] < part.to)) t[i] = kNoHitDistance;
    }
    return t;
}

/// A turned box and two planes, one of them far from perpendicular to any axis.
std::vector<ClipDescription> clipsOfSize(double size) {
    const double c = std::cos(0.6), s = std::sin(0.6);
    const ClipBox box{
        size * Vec3{-0.9, -0.7, -0.8}, size * Vec3{0.5, 0.9, 0.7}, {Vec3{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
    const ClipPlane slanted{size * Vec3{0.1, 0, 0.2}, normalize({-1, 2, -3})},
        level{size * Vec3{0, 0, -0.6}, {0, 0, 1}};
    return {{box}, {slanted}, {level}};
}

std::string sceneText(const std::string& file, const std::vector<ClipDescription>& clips) {
    const auto n = [](double v) { return std::to_string(v); };
    const auto list = [&](Vec3 v) { return "[" + n(v.x) + ", " + n(v.y) + ", " + n(v.z) + "]"; };
    std::string text = "[[instance]]\nfile = \"" + file + "\"\n";
    for (const ClipDescription& clip : clips) {
        text += "[[clip]]\n";
        if (const auto* box = std::get_if<ClipBox>(&clip.form))
            text += "type = \"box\"\nmin = " + list(box->low) + "\nmax = " + list(box->high) +
                    "\nrotate = {axis = [0, 0, 1], degrees = " + n(0.6 * 180 / std::numbers::pi) + "}\n";
        if (const auto* plane = std::get_if<ClipPlane>(&clip.form))
            text += "type = \"plane\"\npoint = " + list(plane->point) + "\nnormal = " + list(plane->normal) + "\n";
    }
    return text;
}

class Clips : public testing::Test {
protected:
    std::string file(const std::string& name, const std::string& text) {
        std::ofstream(folder.file(name)) << text;
        return folder.file(name);
    }

    /// Fails if more than one in a hundred rays differ: those that graze a rim, or hit within rounding of a plane.
    void expectClipped(const std::string& scan, double size, double tolerance) {
        const std::vector<ClipDescription> clips = clipsOfSize(size);
        const TraceScene whole(device, {scan}), cut(device, {file("cut.toml", sceneText(scan, clips))});
        const std::vector<double> rays = clippedRays(size);
        const std::vector<double> t = distancesOf(cut, rays);
        const std::vector<double> expected = clippedDistances(whole, keptHalfSpaces(clips), rays);
        std::vector<std::uint8_t> occluded(kClippedRays);
        cut.testOcclusions(std::span<const double>(rays), {}, occluded);
        std::size_t others = 0, hits = 0;
        for (std::size_t i = 0; i < kClippedRays; ++i) {
            const bool is_hit = std::isfinite(expected[i]);
            hits += is_hit;
            others += std::isfinite(t[i]) != is_hit || (is_hit && std::abs(t[i] - expected[i]) > tolerance * size) ||
                      (occluded[i] != 0) != is_hit;
        }
        EXPECT_LT(others, kClippedRays / 100) << scan;
        EXPECT_GT(hits, kClippedRays / 20) << "the test is empty";
        EXPECT_LT(hits, kClippedRays - kClippedRays / 20) << "the test is empty";
    }

    TemporaryFolder folder;
    TraceDevice device;
};

TEST_F(Clips, DiscsAreHitInWhatIsKept) {
    const std::string path = folder.file("discs.pro");
    writeScene(path, sphereSplats(8000, Vec3f(0, 0, 0), 1), {});
    expectClipped(path, 1, 2e-3);
}

TEST_F(Clips, BallsAreCutOpen) {
    const std::string path = folder.file("balls.pro");
    Splats splats = randomSplats(600, 5, 0.02f, 0.1f);
    for (Vec3f& position : splats.positions) position = 2 * position - Vec3f(1, 1, 1);
    makeBalls(splats);
    writeScene(path, splats, {});
    expectClipped(path, 1, 2e-2);
}

TEST_F(Clips, GaussiansAreCutAtTheirPeaks) {
    const GaussianFile gaussians(makeGaussians("inside", 300));
    expectClipped(gaussians.path, 0.5, 1e-3);
}

TEST_F(Clips, TheFarWallIsHitExactlyWhereTheNearOneIsCut) {
    const std::string path = folder.file("sphere.pro");
    writeScene(path, sphereSplats(20000, Vec3f(0, 0, 0), 1), {});
    const TraceScene cut(device, {path}, {.clips = {{-2, -2, -2, 2, 2, 0.5}}}); // without the cap above z = 0.5
    std::vector<double> rays;
    const double rim = std::sqrt(1 - 0.25);
    for (int i = 0; i < 99; ++i) addRay(rays, {0.01 * i, 0, 3}, {0, 0, -1});
    const std::vector<double> t = distancesOf(cut, rays);
    for (int i = 0; i < 99; ++i) {
        const double x = 0.01 * i, z = std::sqrt(1 - x * x);
        if (std::abs(x - rim) < 0.02) continue; // the discs at the cut
        EXPECT_NEAR(t[static_cast<std::size_t>(i)], x < rim ? 3 + z : 3 - z, 0.01) << x;
    }
}

TEST_F(Clips, RaysInThePlaneOrParallelToItHitWhatIsInside) {
    const std::string path = folder.file("sphere.pro");
    writeScene(path, sphereSplats(20000, Vec3f(0, 0, 0), 1), {});
    const TraceScene cut(device, {path}, {.clips = {{-2, -2, -2, 2, 2, 0.5}}});
    std::vector<double> rays;
    for (const double z : {0.4, 0.6}) addRay(rays, {-3, 0, z}, {1, 0, 0});
    const std::vector<double> t = distancesOf(cut, rays);
    EXPECT_NEAR(t[0], 3 - std::sqrt(1 - 0.16), 0.01);
    EXPECT_EQ(t[1], kNoHitDistance);
}

TEST_F(Clips, InstancesMayStayWhole) {
    const std::string path = folder.file("sphere.pro");
    writeScene(path, sphereSplats(8000, Vec3f(0, 0, 0), 1), {});
    const std::string clip = "[[clip]]\ntype = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, -1]\n";
    const std::string instances = "[[instance]]\nfile = \"" + path + "\"\n[[instance]]\nfile = \"" + path +
                                  "\"\ntranslate = [10, 0, 0]\nclip = false\n";
    const TraceScene scene(device, {file("scene.toml", instances + clip)});
    std::vector<double> rays;
    for (const double x : {0, 10}) addRay(rays, {x, 0, 3}, {0, 0, -1});
    const std::vector<double> t = distancesOf(scene, rays);
    EXPECT_NEAR(t[0], 4, 0.01);
    EXPECT_NEAR(t[1], 2, 0.01);
}

TEST_F(Clips, GridCoordinates_TheCutIsWhereItIsGiven) {
    const GridPlace place; // hundreds of kilometres from the origin
    const std::string path = folder.file("sphere.pro");
    writeScan(path, sphereSplats(20000, 0.4f), place);
    const double edge = place.edge;
    const std::array<double, 3>& o = place.origin;
    const double height = o[2] + 0.6 * edge;
    const TraceScene cut(device, {path}, {.clips = {{o[0], o[1], o[2], o[0] + edge, o[1] + edge, height}}});
    std::vector<double> rays;
    const Vec3 middle{o[0] + 0.5 * edge, o[1] + 0.5 * edge, height};
    // towards the wall, a thousandth of the edge below the cut and above it
    for (const double z : {-1e-3, 1e-3}) addRay(rays, {middle.x, middle.y, middle.z + z * edge}, {1, 0, 0});
    const std::vector<double> t = distancesOf(cut, rays);
    EXPECT_NEAR(t[0], edge * std::sqrt(0.16 - 0.01), 0.01 * edge);
    EXPECT_EQ(t[1], kNoHitDistance);
}

TEST_F(Clips, TilesOfSetsAreCutAlike) {
    const SphereInTiles ball;
    const Vec3 c = ball.center, low = c - Vec3{50, 50, 50}, high = c + Vec3{7, 50, 19};
    const SceneOptions options{.clips = {{low.x, low.y, low.z, high.x, high.y, high.z}}};
    const TraceScene whole(device, {ball.tiles()}), cut(device, {ball.tiles()}, options);
    const std::vector<double> rays = raysAround(c, 60, kClippedRays, 3);
    const std::vector<double> t = distancesOf(cut, rays);
    const std::vector<double> expected =
        clippedDistances(whole, keptHalfSpaces(std::vector{clipBox(options.clips[0])}), rays);
    std::size_t others = 0;
    for (std::size_t i = 0; i < kClippedRays; ++i)
        others += std::isfinite(t[i]) != std::isfinite(expected[i]) ||
                  (std::isfinite(t[i]) && std::abs(t[i] - expected[i]) * length(directionOf(rays, i)) > 0.1);
    EXPECT_LT(others, kClippedRays / 100);
}

TEST_F(Clips, RefusesBoxesThatHoldNothing) {
    const std::string path = folder.file("sphere.pro");
    writeScene(path, sphereSplats(100, Vec3f(0, 0, 0), 1), {});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::array<double, 6> good{0, 0, 0, 1, 1, 1};
    const std::vector<std::vector<std::array<double, 6>>> refused = {
        {{0, 0, 0, 1, 0, 1}}, {{0, 0, nan, 1, 1, 1}}, {6, good}};
    for (const auto& clips : refused) try {
            const TraceScene scene(device, {path}, {.clips = clips});
            ADD_FAILURE() << "nothing was thrown";
        } catch (const TraceError& error) {
            EXPECT_EQ(error.kind, TraceError::Kind::kBadUsage) << error.what();
        }
}

} // namespace
} // namespace pointrt::test
