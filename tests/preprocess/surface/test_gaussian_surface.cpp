// SPDX-License-Identifier: Apache-2.0
// The surface of a capture, and the up that it shows.
#include "preprocess/surface/gaussian_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>

#include "preprocess/surface/find_up.h"

namespace pointrt {
namespace {

/// Gaussians; z is up unless they are turned.
class Capture {
public:
    /// @param deviations the third is along the normal
    void add(const Vec3d& center, const Eigen::Quaterniond& turn, const Vec3d& deviations, double opacity) {
        centers_.push_back(center);
        turns_.push_back(turn);
        deviations_.push_back(deviations);
        opacities_.push_back(static_cast<float>(opacity));
    }
    /// A rectangle of flat Gaussians: corner + [0, 1] u + [0, 1] v.
    void addRectangle(const Vec3d& corner, const Vec3d& u, const Vec3d& v, double opacity) {
        const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitZ(), u.cross(v));
        const auto count = static_cast<int>(20 * u.cross(v).norm());
        for (int i = 0; i < count; ++i)
            add(corner + share() * u + share() * v, turn, {0.1 + 0.1 * share(), 0.1, 0.005}, opacity);
    }
    /// A box without its underside.
    void addBox(const Vec3d& low, const Vec3d& size) {
        const Vec3d x = size.x() * Vec3d::UnitX(), y = size.y() * Vec3d::UnitY(), z = size.z() * Vec3d::UnitZ();
        addRectangle(low + z, x, y, 0.9);
        for (const auto& [corner, side] : {std::pair(low, x), {low + y, x}, {low, y}, {low + x, y}})
            addRectangle(corner, side, z, 0.9);
    }
    double share() { return std::uniform_real_distribution<double>(0, 1)(random_); }

    Cloud cloud(const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) const {
        Cloud cloud;
        std::vector<float> rotations, deviations;
        for (std::size_t i = 0; i < centers_.size(); ++i) {
            cloud.positions.push_back((turn * centers_[i]).cast<float>());
            const Eigen::Quaterniond turned = turn * turns_[i];
            for (double part : {turned.w(), turned.x(), turned.y(), turned.z()})
                rotations.push_back(static_cast<float>(part));
            for (double deviation : deviations_[i]) deviations.push_back(static_cast<float>(deviation));
        }
        addColumn(cloud, kGaussianOpacity, 1, opacities_);
        addColumn(cloud, kGaussianDeviation, 3, deviations);
        addColumn(cloud, kGaussianRotation, 4, rotations);
        addColumn(cloud, kGaussianColor, 3, std::vector<float>(3 * centers_.size(), 0.5f));
        return cloud;
    }

private:
    static void addColumn(Cloud& cloud, std::string_view name, std::uint32_t components,
                          const std::vector<float>& values) {
        Attribute column;
        column.name = std::string(name);
        column.type = Scalar::kF32;
        column.components = components;
        column.values.resize(values.size() * sizeof(float));
        std::memcpy(column.values.data(), values.data(), column.values.size());
        cloud.attributes.push_back(std::move(column));
    }

    std::vector<Vec3d> centers_, deviations_;
    std::vector<Eigen::Quaterniond> turns_;
    std::vector<float> opacities_;
    std::mt19937 random_{1};
};

/// Boxes on the ground, within a haze of faint Gaussians and a sky of giants.
Capture garden() {
    Capture capture;
    capture.addRectangle({-5, -4, 0}, {10, 0, 0}, {0, 8, 0}, 0.8);
    for (int i = 0; i < 4; ++i) capture.addBox({-4.0 + 2 * i, -3.0 + 1.5 * i, 0}, {1, 0.8, 0.5 + 0.5 * i});
    const auto any = Eigen::Quaterniond::Identity();
    for (int i = 0; i < 5000; ++i)
        capture.add({20 * capture.share() - 10, 20 * capture.share() - 10, 20 * capture.share() - 10}, any,
                    {0.3, 0.3, 0.3}, 0.1);
    for (int i = 0; i < 50; ++i) {
        const double angle = 2 * std::numbers::pi * i / 50;
        capture.add({40 * std::cos(angle), 40 * std::sin(angle), -20}, any, {8, 8, 8}, 0.9);
    }
    return capture;
}

FoundUp upOf(const Cloud& cloud) {
    return findUp(surfaceOfGaussians(cloud, gaussianColumns(cloud).value()), {}, {-Vec3d::UnitY(), false});
}

TEST(GaussianSurface, CapturesStandOnTheirGroundInAnyFrame) {
    const Capture capture = garden();
    for (const Vec3d& up : {Vec3d(Vec3d::UnitZ()), Vec3d(Vec3d::UnitY()), Vec3d(-Vec3d::UnitY())}) {
        const FoundUp found = upOf(capture.cloud(Eigen::Quaterniond::FromTwoVectors(Vec3d::UnitZ(), up)));
        EXPECT_EQ(found.basis, UpBasis::kData) << found.reason;
        EXPECT_TRUE(found.up.isApprox(up)) << found.up.transpose();
    }
}

TEST(GaussianSurface, FogHasTheUpOfItsFormat) {
    Capture capture;
    for (int i = 0; i < 4000; ++i) {
        Vec3d at(capture.share(), capture.share(), capture.share());
        at = 2 * at - Vec3d::Ones();
        if (at.norm() < 1) capture.add(at, Eigen::Quaterniond::Identity(), {0.1, 0.1, 0.1}, 0.9);
    }
    const FoundUp found = upOf(capture.cloud());
    EXPECT_EQ(found.basis, UpBasis::kCustom) << found.reason;
    EXPECT_EQ(found.up, -Vec3d::UnitY());
}

TEST(GaussianSurface, FaintAndHugeGaussiansAreNoSurface) {
    Capture capture;
    const auto any = Eigen::Quaterniond::Identity();
    for (int i = 0; i < 1000; ++i) capture.add({0.001 * i, 0, 0}, any, {0.001, 0.001, 0.0001}, 0.9);
    for (int i = 0; i < 1000; ++i) capture.add({0.001 * i, 5, 0}, any, {0.1, 0.1, 0.0001}, 0.2);
    capture.add({0.5, -5, 0}, any, {0.3, 0.3, 0.3}, 1);
    const Cloud cloud = capture.cloud();
    const Splats splats = surfaceOfGaussians(cloud, gaussianColumns(cloud).value());
    ASSERT_FALSE(splats.positions.empty());
    for (const Vec3f& at : splats.positions) ASSERT_NEAR(at.y(), 0, 0.001f);
    for (const Vec3f& normal : splats.normals) ASSERT_EQ(normal.cwiseAbs(), Vec3f(Vec3f::UnitZ()));
}

TEST(GaussianSurface, DiscsCoverAreasEvenly) {
    Capture capture;
    const auto any = Eigen::Quaterniond::Identity();
    // two squares of the same size, of many small and a few large Gaussians
    for (int i = 0; i < 10000; ++i) capture.add({capture.share(), capture.share(), 0}, any, {0.01, 0.01, 0.001}, 0.8);
    for (int i = 0; i < 100; ++i) capture.add({2 + capture.share(), capture.share(), 0}, any, {0.1, 0.1, 0.01}, 0.8);
    const Cloud cloud = capture.cloud();
    const Splats splats = surfaceOfGaussians(cloud, gaussianColumns(cloud).value());
    const auto large =
        std::count_if(splats.positions.begin(), splats.positions.end(), [](const Vec3f& at) { return at.x() > 1.5f; });
    EXPECT_NEAR(double(large) / double(splats.positions.size()), 0.5, 0.01);
}

} // namespace
} // namespace pointrt
