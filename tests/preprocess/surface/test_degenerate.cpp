// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "format/base/error.h"
#include "tests/preprocess/surface/shapes.h"
#include "tests/support/says.h"

namespace pointrt::test {
namespace {

std::string reasonFor(Cloud cloud, const SurfaceOptions& options = {}) {
    try {
        estimate(std::move(cloud), options);
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadInput);
        return error.what();
    }
    return "no error";
}

Cloud cloudOf(std::vector<Vec3f> positions) {
    Cloud cloud;
    cloud.positions = std::move(positions);
    return cloud;
}

TEST(Degenerate, TooFewPoints) {
    EXPECT_SAYS(reasonFor({}), "0 *at least 3");
    EXPECT_SAYS(reasonFor(cloudOf({{1, 2, 3}})), "1 *at least 3");
    EXPECT_SAYS(reasonFor(cloudOf({{1, 2, 3}, {3, 2, 1}})), "2 *at least 3");
}

TEST(Degenerate, AllEqual) { EXPECT_SAYS(reasonFor(cloudOf(std::vector<Vec3f>(7, Vec3f(1, 2, 3)))), "all 7 *equal"); }

TEST(Degenerate, AllOnLine) {
    std::vector<Vec3f> line;
    for (int i = 0; i < 1000; ++i) line.push_back(Vec3f(1, 2, 3) + 0.1f * float(i) * Vec3f(0.3f, -0.7f, 0.2f));
    EXPECT_SAYS(reasonFor(cloudOf(line)), "all 1000 *line");
    EXPECT_SAYS(reasonFor(cloudOf({{0, 0, 0}, {0, 0, 0}, {1, 0, 0}})), "all 3 *line");
    std::vector<Vec3f> bent = line;
    bent.push_back(Vec3f(0, 0, 0));
    EXPECT_EQ(reasonFor(cloudOf(bent)), "no error");
    line.push_back(Vec3f(1e9f, 1e9f, 0));
    EXPECT_SAYS(reasonFor(cloudOf(line)), "all 1001 *line") << "with a distant outlier";
}

TEST(Degenerate, DistantOutliersDoNotMakeALine) {
    const std::vector<Vec3f> sphere = randomSphere(1000).positions;
    for (const float distance : {1e4f, 1e6f, 1e9f, 1e20f}) {
        std::vector<Vec3f> with_outlier = sphere;
        with_outlier.insert(with_outlier.begin(), Vec3f(distance, 0, 0));
        EXPECT_EQ(reasonFor(cloudOf(with_outlier)), "no error") << distance;
    }
}

TEST(Degenerate, OutliersBeyondFloatAreDropped) {
    const std::vector<Vec3f> sphere = randomSphere(1000).positions;
    SurfaceReport alone_report;
    const Splats alone = estimateSplats(cloudOf(sphere), {}, alone_report);
    for (const float distance : {1e19f, 1e25f, 1e30f, 3e38f}) {
        std::vector<Vec3f> with_outlier = sphere;
        with_outlier.insert(with_outlier.begin() + 500, Vec3f(distance, -distance, 0));
        SurfaceReport report;
        const Splats splats = estimateSplats(cloudOf(with_outlier), {}, report);
        EXPECT_EQ(report.outliers_removed, 1u) << distance;
        EXPECT_EQ(report.duplicates_removed, 0u) << distance;
        ASSERT_EQ(splats.positions.size(), 1000u) << distance;
        for (std::size_t i = 0; i < 1000; ++i) {
            ASSERT_EQ(splats.positions[i], alone.positions[i]) << distance;
            ASSERT_EQ(splats.radii[i], alone.radii[i]) << distance;
            ASSERT_EQ(splats.input_index[i], alone.input_index[i] + (alone.input_index[i] >= 500)) << distance;
        }
    }
}

TEST(Degenerate, MissingNormalsAndSensors) {
    Cloud cloud = randomSphere(100).cloud();
    cloud.normals.assign(100, Vec3f::UnitX());
    cloud.normals[3].setZero();
    cloud.normals[4].setConstant(std::numeric_limits<float>::quiet_NaN());
    SurfaceOptions keep, sensor;
    keep.normals = NormalSource::kKeep;
    sensor.orient = OrientMode::kSensor;
    EXPECT_SAYS(reasonFor(cloud, keep), "2 of 100 *--normals auto");
    EXPECT_SAYS(reasonFor(cloud, sensor), "100 of 100 *sensor");
}

TEST(Degenerate, OptionsOutOfRange) {
    SurfaceOptions options;
    options.neighbors = 2;
    EXPECT_THROW(estimate(randomSphere(100).cloud(), options), Error);
    options = {};
    options.radius_scale = 0;
    EXPECT_THROW(estimate(randomSphere(100).cloud(), options), Error);
}

void expectSoundSplats(const Splats& splats) {
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        EXPECT_TRUE(splats.positions[i].allFinite());
        EXPECT_NEAR(splats.normals[i].norm(), 1, 1e-5);
        EXPECT_TRUE(std::isfinite(splats.radii[i]));
        EXPECT_GT(splats.radii[i], 0);
    }
}

TEST(Degenerate, TinyCloudsHaveSoundSplats) {
    for (std::size_t count = 3; count < 40; ++count) {
        const Splats splats = estimate(randomSphere(count).cloud());
        EXPECT_EQ(splats.positions.size(), count);
        expectSoundSplats(splats);
    }
}

TEST(Degenerate, AnyScaleOfCoordinates) {
    const Shape shape = randomSphere(2000);
    for (const double scale : {1e-30, 1e-6, 1.0, 1e6, 1e30}) {
        Cloud cloud;
        for (const Vec3f& p : shape.positions) cloud.positions.push_back((p.cast<double>() * scale).cast<float>());
        const Splats splats = estimate(std::move(cloud));
        expectSoundSplats(splats);
        EXPECT_LT(normalErrors(splats, shape).back(), 10);
        EXPECT_LT(*std::max_element(splats.radii.begin(), splats.radii.end()), 0.5 * scale);
    }
}

TEST(Degenerate, PointsMuchCloserThanTheExtent) {
    Shape shape = randomSphere(2000, Vec3d::Zero(), 1e-25);
    shape.append(randomSphere(2000));
    expectSoundSplats(estimate(shape.cloud()));
}

} // namespace
} // namespace pointrt::test
