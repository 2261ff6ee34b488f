// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/preprocess/surface/shapes.h"
#include "tests/support/mean.h"

namespace pointrt::test {
namespace {

double p99Of(const std::vector<double>& sorted) { return sorted[sorted.size() * 99 / 100]; }

// Bounds are twice the measured values, in degrees.

TEST(Normals, FibonacciSphere) {
    const Shape shape = fibonacciSphere(20'000);
    const auto errors = normalErrors(estimate(shape.cloud()), shape);
    EXPECT_LT(meanOf(errors), 0.1);
    EXPECT_LT(errors.back(), 0.5);
}

TEST(Normals, RandomSphere) {
    const Shape shape = randomSphere(20'000);
    const auto errors = normalErrors(estimate(shape.cloud()), shape);
    EXPECT_LT(meanOf(errors), 0.8);
    EXPECT_LT(p99Of(errors), 2.2);
}

TEST(Normals, RandomTorus) {
    const Shape shape = randomTorus(20'000);
    const auto errors = normalErrors(estimate(shape.cloud()), shape);
    EXPECT_LT(meanOf(errors), 2);
    EXPECT_LT(p99Of(errors), 6);
}

/// Noise of a quarter of the spacing to either side, as in overlapping range scans.
TEST(Normals, NoiseIsAveragedOverWiderNeighborhoods) {
    Shape shape = randomSphere(50'000);
    Random random(5);
    for (Vec3f& p : shape.positions) p *= float(1 + 0.008 * (uniform(random) - 0.5));
    const auto errors = normalErrors(estimate(shape.cloud()), shape);
    EXPECT_LT(meanOf(errors), 1);
    EXPECT_LT(p99Of(errors), 3);
}

TEST(Normals, CubeEdgesStaySharp) {
    const Shape shape = gridCube(40);
    const Splats splats = estimate(shape.cloud());
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        const Vec3f p = splats.positions[i], truth = shape.normals[splats.input_index[i]];
        float from_edge = 1;
        for (int axis = 0; axis < 3; ++axis)
            if (truth[axis] == 0) from_edge = std::min({from_edge, p[axis], 1 - p[axis]});
        // three rows from the edge, no neighbour is on the other face
        if (from_edge > 3.0f / 40) {
            EXPECT_LT(degreesBetween(splats.normals[i], truth), 1) << p.transpose();
        }
        EXPECT_LT(degreesBetween(splats.normals[i], truth), 56) << "more than the corner's bisector, " << p.transpose();
    }
}

TEST(Normals, GivenOnesAreKeptAndOthersEstimated) {
    const Shape shape = randomSphere(5000);
    Cloud cloud = shape.cloud();
    const Vec3f odd = Vec3f(1, 2, 3).normalized();
    cloud.normals.assign(5000, Vec3f::Zero());
    for (std::size_t i = 0; i < 5000; i += 10) cloud.normals[i] = 7 * odd;
    SurfaceReport report;
    const Splats splats = estimateSplats(Cloud(cloud), {}, report);
    EXPECT_EQ(report.normals_estimated, 4500u);
    for (std::size_t i = 0; i < 5000; ++i)
        if (splats.input_index[i] % 10 == 0) {
            EXPECT_LT((splats.normals[i] - odd).norm(), 1e-6);
        }

    SurfaceOptions options;
    options.normals = NormalSource::kEstimate;
    const auto errors = normalErrors(estimate(std::move(cloud), options), shape);
    EXPECT_LT(errors.back(), 15) << "kEstimate ignores given normals";
}

TEST(Normals, KeepKeepsAll) {
    const Shape shape = randomSphere(5000);
    Cloud cloud = shape.cloud();
    cloud.normals = shape.normals;
    for (Vec3f& normal : cloud.normals) normal = -normal; // the given normals point inwards
    SurfaceOptions options;
    options.normals = NormalSource::kKeep;
    SurfaceReport report;
    const Splats splats = estimateSplats(std::move(cloud), options, report);
    EXPECT_EQ(report.normals_estimated, 0u);
    EXPECT_EQ(report.normals_flipped, 0u);
    EXPECT_GT(normalErrors(splats, shape).front(), 179.9);
}

} // namespace
} // namespace pointrt::test
