// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/preprocess/surface/shapes.h"

namespace pointrt::test {
namespace {

/// Sum of the blending weights (1 - d^2 / r^2)^2 of all discs at a place.
double weightAt(const Splats& splats, const Vec3f& place) {
    double sum = 0;
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        const float squared = (splats.positions[i] - place).squaredNorm() / (splats.radii[i] * splats.radii[i]);
        if (squared < 1) sum += (1 - squared) * (1 - squared);
    }
    return sum;
}

/// The least weight at random places of [0, 1]^2, at least margin from its border.
double leastWeight(const Splats& splats, double margin) {
    Random random(11);
    double least = 1e9;
    for (int i = 0; i < 4000; ++i) {
        const double x = margin + (1 - 2 * margin) * uniform(random), y = margin + (1 - 2 * margin) * uniform(random);
        least = std::min(least, weightAt(splats, Vec3f(float(x), float(y), 0)));
    }
    return least;
}

float medianRadius(Splats splats) {
    const auto middle = splats.radii.begin() + std::ptrdiff_t(splats.radii.size() / 2);
    std::nth_element(splats.radii.begin(), middle, splats.radii.end());
    return *middle;
}

/// Whether a point of a steps x steps grid on [0, 1]^2, each moved by less than half a step, is in the outermost row.
bool onBorder(const Vec3f& p, int steps) {
    return std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()}) < 0.75f / float(steps);
}

/// Discs overlap by 1.4, along the border by 1.2.
void expectSquareCells(const Splats& splats, int steps) {
    const double closing = std::numbers::sqrt2 / 2 / steps;
    for (std::size_t i = 0; i < splats.radii.size(); ++i) {
        const Vec3f& p = splats.positions[i];
        EXPECT_NEAR(splats.radii[i], (onBorder(p, steps) ? 1.2 : 1.4) * closing, 1e-2 * closing) << p.transpose();
    }
}

TEST(Radii, GivenOnesStay) {
    const Shape shape = gridPlane(40, 0, Vec3d::UnitZ());
    Cloud cloud = shape.cloud();
    cloud.radii.assign(cloud.positions.size(), 0);
    cloud.radii[7] = 0.25f;
    const Splats splats = estimate(cloud), alone = estimate(shape.cloud());
    for (std::size_t i = 0; i < splats.radii.size(); ++i)
        EXPECT_EQ(splats.radii[i], splats.input_index[i] == 7 ? 0.25f : alone.radii[i]);
}

TEST(Radii, GridIsClosedByTheSmallestDiscs) {
    const Splats splats = estimate(gridPlane(50).cloud());
    EXPECT_GT(leastWeight(splats, 0), 0.1) << "up to the border, half a spacing outside the last points";
    EXPECT_GT(leastWeight(splats, 0.03), 0.9);
    expectSquareCells(splats, 50);
}

TEST(Radii, HexagonsPoissonAndRandomPlanesAreClosed) {
    EXPECT_GT(leastWeight(estimate(hexPlane(50).cloud()), 0.05), 0.6);
    EXPECT_GT(leastWeight(estimate(poissonPlane(0.02).cloud()), 0.05), 0.5);
    EXPECT_GT(leastWeight(estimate(randomPlane(4000).cloud()), 0.05), 0.5);
}

TEST(Radii, ScaleMultiplies) {
    SurfaceOptions options;
    options.radius_scale = 2.5;
    const Splats plain = estimate(gridPlane(30).cloud()), scaled = estimate(gridPlane(30).cloud(), options);
    for (std::size_t i = 0; i < plain.radii.size(); ++i) EXPECT_NEAR(scaled.radii[i], 2.5 * plain.radii[i], 1e-6);
}

TEST(Radii, BorderIsNotBloated) {
    const Splats splats = estimate(randomPlane(4000).cloud());
    const float typical = medianRadius(splats);
    for (std::size_t i = 0; i < splats.radii.size(); ++i) {
        const Vec3f& p = splats.positions[i];
        const float from_border = std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()});
        EXPECT_LT(splats.radii[i] - from_border, 3.5f * typical) << "sticks out";
        EXPECT_LT(splats.radii[i], 4 * typical);
    }
}

/// Mean and maximum overhang of discs over the border of a square of random points, in spacings.
TEST(Radii, DiscsEndAtTheBorder) {
    constexpr std::size_t kCount = 20'000;
    const Splats splats = estimate(randomPlane(kCount).cloud());
    double sum = 0, most = 0;
    std::size_t hanging = 0;
    for (std::size_t i = 0; i < splats.positions.size(); ++i) {
        const Vec3f& p = splats.positions[i];
        const double over = splats.radii[i] - std::min({p.x(), p.y(), 1 - p.x(), 1 - p.y()});
        if (over <= 0) continue;
        ++hanging;
        sum += over;
        most = std::max(most, over);
    }
    const double spacing = 1 / std::sqrt(double(kCount));
    EXPECT_LT(sum / double(hanging), 0.8 * spacing); // measured: 0.70; 0.95 if corners beyond the border count
    EXPECT_LT(most, 3 * spacing);                    // measured: 2.7; 3.4 without
}

/// A round hole with a radius of 1.5 spacings is a gap of the sampling, and closed.
TEST(Radii, GapsAreClosed) {
    constexpr std::size_t kCount = 10'000;
    const Vec3f middle(0.5f, 0.5f, 0);
    Shape plane = randomPlane(kCount), holed;
    for (const Vec3f& p : plane.positions)
        if ((p - middle).norm() > 0.015f) holed.add(p.cast<double>(), Vec3d::UnitZ());
    const Splats splats = estimate(holed.cloud());
    for (int i = -10; i <= 10; ++i)
        for (int k = -10; k <= 10; ++k)
            EXPECT_GT(weightAt(splats, middle + Vec3f(0.0015f * float(i), 0.0015f * float(k), 0)), 0.05)
                << i << " " << k;
}

/// Dense to the left of 0.5, a hundred times sparser to the right.
TEST(Radii, DensityJumpIsClosed) {
    Shape shape;
    for (const auto& [steps, from, to] : {std::tuple{200, 0.0, 0.5}, {20, 0.5, 1.0}})
        for (int i = 0; i < steps; ++i)
            for (int j = 0; j < steps; ++j) {
                const double x = (i + 0.5) / steps;
                if (x >= from && x < to) shape.add(Vec3d(x, (j + 0.5) / steps, 0), Vec3d::UnitZ());
            }
    const Splats splats = estimate(shape.cloud());
    EXPECT_GT(leastWeight(splats, 0.06), 0.3);
    for (std::size_t i = 0; i < splats.radii.size(); ++i)
        if (splats.positions[i].x() < 0.4f) {
            EXPECT_LT(splats.radii[i], 1.5f / 200) << "dense discs stay small";
        }
}

TEST(Radii, SparseGroupsStaySmall) {
    // nine points far apart, which are each other's neighbours, above a dense plane
    Shape shape = gridPlane(150);
    for (int i = 0; i < 9; ++i) shape.add(Vec3d(0.4 * (i % 3), 0.4 * (i / 3), 5), Vec3d::UnitZ());
    SurfaceOptions options;
    options.remove_outliers = false;
    const Splats splats = estimate(shape.cloud(), options);
    const float spacing = 1.0f / 150;
    EXPECT_LT(*std::max_element(splats.radii.begin(), splats.radii.end()), 3 * spacing);
}

TEST(Radii, IsolatedPointsStaySmall) {
    Shape shape = gridPlane(30);
    shape.add(Vec3d(0.5, 0.5, 10), Vec3d::UnitZ());
    const Splats splats = estimate(shape.cloud()); // too few points to remove outliers
    EXPECT_LT(*std::max_element(splats.radii.begin(), splats.radii.end()), 0.7);
}

TEST(Radii, SheetsOfThinPlateDoNotShrinkEachOther) {
    Shape shape = gridPlane(50, 0, -Vec3d::UnitZ());
    for (const Vec3f& p : gridPlane(50).positions) // a quarter of a spacing above, half a cell to the side
        shape.add(p.cast<double>() + Vec3d(0.01, 0.01, 0.005), Vec3d::UnitZ());
    Cloud cloud = shape.cloud();
    cloud.normals = shape.normals;
    Splats splats = estimate(std::move(cloud));
    for (std::size_t i = 0; i < splats.positions.size(); ++i)
        if (splats.normals[i].z() > 0) splats.positions[i] -= Vec3f(0.01f, 0.01f, 0.005f);
    expectSquareCells(splats, 50);
}

TEST(Radii, DiscsReachTheEdgesOfACube) {
    const Shape shape = gridCube(30);
    Cloud cloud = shape.cloud();
    cloud.normals = shape.normals;
    const Splats splats = estimate(std::move(cloud));
    for (int i = 0; i < 500; ++i) EXPECT_GT(weightAt(splats, Vec3f(float(i) / 500, 0, 0)), 0.1);
}

/// Checks the overlap of a cube's discs beside its edges and elsewhere: their radii over those of discs that just close
/// its square cells.
void expectOverlaps(const Cloud& cloud, double beside_edge, double elsewhere) {
    constexpr int kSteps = 30;
    const Splats splats = estimate(cloud);
    for (std::size_t i = 0; i < splats.radii.size(); ++i) {
        const Vec3f p = splats.positions[i], inwards = p.cwiseMin(Vec3f::Ones() - p);
        const auto near_faces = (inwards.array() < 0.75f / kSteps).count(); // above 1: half a step from an edge
        const double overlap = double(splats.radii[i]) * kSteps * std::numbers::sqrt2;
        EXPECT_NEAR(overlap, near_faces > 1 ? beside_edge : elsewhere, 1e-3) << p.transpose();
    }
}

TEST(Radii, DiscsHangLessOverRidgesThanIntoValleys) {
    const Shape shape = gridCube(30);
    Cloud cloud = shape.cloud();
    cloud.normals = shape.normals;
    expectOverlaps(cloud, 1.2, 1.4);
    for (Vec3f& normal : cloud.normals) normal = -normal; // a room: its edges are valleys
    expectOverlaps(cloud, 1.4, 1.4);
}

TEST(Radii, NoiseIsNotARidge) {
    Shape shape = gridPlane(100);
    Random random(5);
    for (Vec3f& p : shape.positions) p.z() = float(0.5 / 100 * (2 * uniform(random) - 1)); // half a spacing each way
    SurfaceOptions options;
    options.clean = 0;
    const Splats splats = estimate(shape.cloud(), options);
    for (std::size_t i = 0; i < splats.radii.size(); ++i) {
        const Vec3f& p = splats.positions[i];
        if (onBorder(p, 100)) continue;
        ASSERT_GT(splats.radii[i], 1.35 / 100 * std::numbers::sqrt2 / 2) << p.transpose();
    }
}

/// Cleaning moves the points of a noisy plane grid back onto the plane. Their discs overlap by 1.2.
TEST(Radii, SmoothedPointsOverlapLess) {
    Shape shape = gridPlane(100);
    addNoise(shape, 0.1 / 100);
    const Splats splats = estimate(shape.cloud());
    for (std::size_t i = 0; i < splats.radii.size(); ++i) {
        const Vec3f& p = splats.positions[i];
        if (onBorder(p, 100) || splats.noise[i] == 0) continue; // clean by coincidence
        ASSERT_NEAR(splats.radii[i], 1.2 / 100 * std::numbers::sqrt2 / 2, 0.02 / 100) << p.transpose();
    }
}

TEST(Radii, ScanLinesAreClosed) {
    Shape shape;
    for (int line = 0; line < 20; ++line)
        for (int i = 0; i < 300; ++i) shape.add(Vec3d((i + 0.5) / 300, (line + 0.5) / 20, 0), Vec3d::UnitZ());
    EXPECT_GT(leastWeight(estimate(shape.cloud()), 0.1), 0.3);
}

TEST(Radii, StraysHaveNoPlates) {
    Shape shape = gridPlane(100);
    Random random(41);
    for (int i = 0; i < 80; ++i)
        shape.add(Vec3d(uniform(random), uniform(random), 0.2 + 0.8 * uniform(random)), Vec3d::UnitZ());
    SurfaceOptions options;
    options.remove_outliers = false;
    const Splats splats = estimate(shape.cloud(), options);
    ASSERT_EQ(splats.positions.size(), shape.positions.size());
    // Points of the plane are 0.01 apart, strays a quarter; discs as wide as their spacing would be plates.
    EXPECT_LT(*std::max_element(splats.radii.begin(), splats.radii.end()), 0.15f);
}

/// The largest radius of points above a plane of points 0.01 apart.
float largestAbove(const Shape& shape) {
    SurfaceOptions options;
    options.remove_outliers = false;
    const Splats splats = estimate(shape.cloud(), options);
    float largest = 0;
    for (std::size_t i = 0; i < splats.positions.size(); ++i)
        if (splats.positions[i].z() + splats.origin.z() > 0.1) largest = std::max(largest, splats.radii[i]);
    return largest;
}

TEST(Radii, ArcsAroundCornersHaveNoPlates) {
    Shape shape = gridPlane(100);
    for (const double z : {0.4, 0.7, 1.0})
        for (int i = 0; i < 50; ++i) {
            shape.add(Vec3d(0.01 * i, 0, z), Vec3d::UnitY());
            shape.add(Vec3d(0, 0.01 * (i + 1), z), Vec3d::UnitX());
        }
    // The sixth neighbour is three steps away, at the ends six.
    EXPECT_LT(largestAbove(shape), 1.4 * 0.06 + 0.001);
}

} // namespace
} // namespace pointrt::test
