// SPDX-License-Identifier: Apache-2.0
// Checks the measures against known errors.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "format/base/error.h"
#include "tests/bench/quality/classify.h"
#include "tests/bench/quality/normals.h"
#include "tests/bench/quality/shapes.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::quality {

namespace {

using std::numbers::pi;

/// By the divergence theorem, for closed meshes with outward faces.
double volumeOf(const Cloud& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum += mesh.positions[a].cast<double>().dot(
            mesh.positions[b].cast<double>().cross(mesh.positions[c].cast<double>()));
    return sum / 6;
}

/// A mesh and splats, read from files and put into one frame.
struct Pair {
    Mesh mesh;
    Discs discs;
};

Pair filePair(const Cloud& mesh, Splats splats) {
    const std::string mesh_path = test::temporaryPath("truth.ply"), scene_path = test::temporaryPath("truth.pro");
    writeMesh(mesh_path, mesh);
    test::writeScene(scene_path, std::move(splats), {});
    Pair pair{loadMesh(mesh_path), {}};
    pair.discs = loadDiscs(scene_path, pair.mesh.frame);
    std::filesystem::remove(mesh_path);
    std::filesystem::remove(scene_path);
    return pair;
}

constexpr std::size_t kSplats = 20000; // radius 0.03

Pair spherePair(Splats splats) { return filePair(makeShape("sphere").mesh, std::move(splats)); }

Splats unitSphere() { return test::sphereSplats(kSplats, Vec3f::Zero(), 1); }

ViewErrors errorsAlong(const Pair& pair, const Vec3f& direction) {
    const Tracing truth(pair.mesh), splats(pair.discs);
    ViewErrors errors;
    classifyView(castView(truth, splats, direction), pair.discs.median_radius, errors);
    return errors;
}

SplatErrors splatErrors(const Pair& pair) { return compareSplats(pair.mesh, Tracing(pair.mesh), pair.discs); }

/// Number of pixels covered by an area in input units.
double pixelsOf(const Pair& pair, double area) { return area / std::pow(kPixel * pair.mesh.frame.radius, 2); }

} // namespace

TEST(Shapes, AreClosedAndKnown) {
    EXPECT_NEAR(volumeOf(makeShape("sphere").mesh), 4 * pi / 3, 2e-4);
    EXPECT_NEAR(volumeOf(makeShape("torus").mesh), 2 * pi * pi * 0.09, 2e-4);
    EXPECT_NEAR(volumeOf(makeShape("cube").mesh), 1, 1e-6);
    EXPECT_NEAR(volumeOf(makeShape("plate").mesh), 0.01, 1e-8);
    EXPECT_THROW(makeShape("ball"), Error);
}

TEST(Shapes, NormalsAreFinerThanATenthOfADegree) {
    for (const char* name : {"sphere", "torus"}) EXPECT_LT(makeShape(name).errors.smooth_normal, 0.1) << name;
}

TEST(Statistics, QuantilesOccur) {
    std::vector<float> values;
    for (int i = 100; i >= 0; --i) values.push_back(static_cast<float>(i));
    const Summary summary = summarize(values);
    EXPECT_EQ(summary.mean, 50);
    EXPECT_EQ(summary.median, 50);
    EXPECT_EQ(summary.p99, 99);
    EXPECT_EQ(summary.max, 100);
    EXPECT_EQ(summarize({}).count, 0u);
}

TEST(Quality, ExactSphereHasNoErrors) {
    const Pair pair = spherePair(unitSphere());
    const SplatErrors splats = splatErrors(pair);
    EXPECT_LT(splats.smooth_normal.max, 0.05); // the .pro's normals have 12 bits a coordinate
    EXPECT_EQ(splats.flipped_share, 0);
    EXPECT_LT(splats.center_distance.max, 0.01);
    const ViewErrors views = errorsAlong(pair, Vec3f::UnitX());
    EXPECT_EQ(views.holes, 0u);
    EXPECT_EQ(views.bridges, 0u);
    EXPECT_NEAR(static_cast<double>(views.mesh_pixels), pixelsOf(pair, pi), 0.001 * pixelsOf(pair, pi));
    EXPECT_EQ(views.missing, 0u);
}

TEST(Quality, FindsTiltedAndFlippedNormals) {
    constexpr double kTilt = 10, kFlipEvery = 4;
    Splats splats = unitSphere();
    for (std::size_t i = 0; i < splats.normals.size(); ++i) {
        Vec3f& normal = splats.normals[i];
        normal =
            std::cos(float(kTilt * pi / 180)) * normal + std::sin(float(kTilt * pi / 180)) * normal.unitOrthogonal();
        if (i % std::size_t(kFlipEvery) == 0) normal = -normal;
    }
    const SplatErrors errors = splatErrors(spherePair(std::move(splats)));
    EXPECT_NEAR(errors.smooth_normal.mean, kTilt, 0.01);
    EXPECT_NEAR(errors.smooth_normal.max, kTilt, 0.1);
    EXPECT_EQ(errors.wrong_share, 0);
    EXPECT_EQ(errors.flipped_share, 1 / kFlipEvery);
}

TEST(Quality, SheetsThatTouchMayFaceEitherWay) {
    Cloud sheet;
    for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        sheet.positions.emplace_back(float(x), float(y), 0.0f);
        sheet.normals.push_back(Vec3f::UnitZ());
    }
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}};
    Splats splats = test::squareSplats(50, Vec3f::Zero(), Vec3f::UnitX(), Vec3f::UnitY());
    for (std::size_t i = 0; i < splats.normals.size(); i += 2) splats.normals[i] = -splats.normals[i];
    const SplatErrors errors = splatErrors(filePair(sheet, std::move(splats)));
    EXPECT_EQ(errors.flipped_share, 0);
    EXPECT_LT(errors.face_normal.max, 0.05);
}

TEST(Quality, CountsTheHole) {
    constexpr double kHole = 0.5; // radius, seen from the front
    Splats all = unitSphere(), splats;
    splats.oriented = true;
    const double radius = all.radii.front();
    for (std::size_t i = 0; i < all.positions.size(); ++i) {
        const Vec3f& position = all.positions[i];
        if (position.x() < 0 && std::hypot(position.y(), position.z()) < kHole) continue;
        splats.positions.push_back(position);
        splats.normals.push_back(all.normals[i]);
        splats.radii.push_back(all.radii[i]);
        splats.input_index.push_back(all.input_index[i]);
    }
    const Pair pair = spherePair(std::move(splats));
    const ViewErrors front = errorsAlong(pair, Vec3f::UnitX()), back = errorsAlong(pair, -Vec3f::UnitX());
    EXPECT_LT(static_cast<double>(front.holes), pixelsOf(pair, pi * kHole * kHole));
    EXPECT_GT(static_cast<double>(front.holes), pixelsOf(pair, pi * std::pow(kHole - radius, 2)));
    EXPECT_EQ(back.holes, 0u);
}

TEST(Quality, CountsFloatingSplats) {
    constexpr float kFloater = 0.1f;
    Splats splats = unitSphere(), floater = test::squareSplats(1, {0, 0, 1.2f}, Vec3f::UnitX(), Vec3f::UnitY());
    floater.radii = {kFloater};
    const Pair pair = spherePair(test::joinSplats(std::move(splats), floater));
    const ViewErrors front = errorsAlong(pair, -Vec3f::UnitZ()), side = errorsAlong(pair, Vec3f::UnitX());
    const double pixels = pixelsOf(pair, pi * kFloater * kFloater);
    EXPECT_NEAR(static_cast<double>(front.bridges), pixels, 0.02 * pixels);
    EXPECT_EQ(side.bridges, 0u); // on edge
    EXPECT_NEAR(splatErrors(pair).center_distance.max, 0.2 / unitSphere().radii.front(), 0.1);
}

TEST(Quality, MeasuresTheOutline) {
    constexpr int kSide = 20; // discs of one spacing's radius, the outermost half a spacing from the edge
    Splats splats = test::squareSplats(kSide, Vec3f::Zero(), 0.5f * Vec3f::UnitX(), 0.5f * Vec3f::UnitY());
    const Pair pair = filePair(makeShape("plate").mesh, std::move(splats));
    const ViewErrors errors = errorsAlong(pair, Vec3f::UnitZ());
    // The mean of sqrt(1 - x^2) - 1/2 for x in [-1/2, 1/2], spacings.
    const double beyond = (std::sqrt(0.75) / 2 + pi / 6 - 0.5) / kSide;
    const double pixel = kPixel * pair.mesh.frame.radius;
    const double mean = static_cast<double>(errors.excess) / static_cast<double>(errors.silhouette_pixels);
    EXPECT_NEAR(mean, beyond / pixel, 1); // edges are anywhere within a pixel
}

} // namespace pointrt::quality
