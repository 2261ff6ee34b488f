// SPDX-License-Identifier: Apache-2.0
// Synthetic scenes whose up is known, upright and tilted.
#include "preprocess/surface/find_up.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

namespace pointrt {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// A surface of rectangles with density splats per unit of area and a noise of 0.01 units.
class Scene {
public:
    explicit Scene(double density = 40) : density_(density) {}

    /// corner + [0, 1] u + [0, 1] v
    void addRectangle(Vec3d corner, Vec3d u, Vec3d v) {
        const Vec3d normal = u.cross(v).normalized();
        const auto count = std::size_t(density_ * u.cross(v).norm());
        for (std::size_t i = 0; i < count; ++i)
            addSplat(corner + share() * u + share() * v + 0.01 * (share() - 0.5) * normal, normal);
    }
    /// All sides of a box; the one on the ground is optional.
    void addBox(Vec3d low, Vec3d size, bool bottom = false) {
        const Vec3d x = size.x() * Vec3d::UnitX(), y = size.y() * Vec3d::UnitY(), z = size.z() * Vec3d::UnitZ();
        addRectangle(low + z, x, y);
        addRectangle(low, x, z);
        addRectangle(low + y, x, z);
        addRectangle(low, y, z);
        addRectangle(low + x, y, z);
        if (bottom) addRectangle(low, x, y);
    }
    void addSplat(const Vec3d& position, const Vec3d& normal) {
        splats.positions.push_back(position.cast<float>());
        splats.normals.push_back(normal.cast<float>());
        splats.radii.push_back(0.1f);
    }
    double share() { return std::uniform_real_distribution<double>(0, 1)(random_); }

    Splats splats;

private:
    double density_;
    std::mt19937 random_{1};
};

Splats turned(Splats splats, const Eigen::Matrix3d& rotation) {
    for (Vec3f& position : splats.positions) position = rotation.cast<float>() * position;
    for (Vec3f& normal : splats.normals) normal = rotation.cast<float>() * normal;
    return splats;
}

/// z is up.
Splats room() {
    Scene scene;
    scene.addBox(Vec3d::Zero(), {6, 5, 2.5}, true);
    scene.addBox({1, 1, 0}, {1.6, 0.8, 0.75});
    scene.addBox({4, 3, 0}, {1.2, 1.5, 0.45});
    scene.addBox({0.1, 3.5, 0}, {0.5, 1.4, 1.1});
    return scene.splats;
}

Splats groundWithBoxes() {
    Scene scene;
    scene.addRectangle({-10, -8, 0}, {20, 0, 0}, {0, 16, 0});
    for (int i = 0; i < 6; ++i) scene.addBox({-8.0 + 3 * i, -6.0 + 2 * i, 0}, {1.5, 1, 1 + 0.5 * i});
    return scene.splats;
}

Splats ball() {
    Scene scene;
    for (int i = 0; i < 20000; ++i) {
        const double z = 2 * scene.share() - 1, angle = 2 * std::numbers::pi * scene.share();
        const Vec3d p(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
        scene.addSplat(p, p);
    }
    return scene.splats;
}

/// A ball cut off at height -0.6.
Splats ballOnABase(bool closed) {
    Splats whole = ball();
    Scene scene;
    for (std::size_t i = 0; i < whole.positions.size(); ++i)
        if (whole.positions[i].z() > -0.6f)
            scene.addSplat(whole.positions[i].cast<double>(), whole.normals[i].cast<double>());
    for (int i = 0; i < 3000 && closed; ++i) {
        const double r = 0.8 * std::sqrt(scene.share()), angle = 2 * std::numbers::pi * scene.share();
        scene.addSplat({r * std::cos(angle), r * std::sin(angle), -0.6}, -Vec3d::UnitZ());
    }
    return scene.splats;
}

std::vector<Scan> scansFrom(const std::vector<Vec3d>& places) {
    std::vector<Scan> scans;
    for (const Vec3d& place : places) scans.push_back({"", place, 0});
    return scans;
}

double degreesBetween(const Vec3d& a, const Vec3d& b) {
    return std::acos(std::clamp(a.normalized().dot(b.normalized()), -1.0, 1.0)) / kDegree;
}

const Eigen::Matrix3d kTilted(Eigen::AngleAxisd(25 * kDegree, Vec3d(1, -2, 0.5).normalized()));
const Eigen::Matrix3d kHardlyTilted(Eigen::AngleAxisd(3 * kDegree, Vec3d(1, -2, 0.5).normalized()));
const Eigen::Matrix3d kYUp(Eigen::AngleAxisd(-90 * kDegree, Vec3d::UnitX()));

TEST(FindUp, RoomsStandOnTheirFloor) {
    const FoundUp found = findUp(room(), {});
    EXPECT_EQ(found.up, Vec3d::UnitZ()) << found.up.transpose();
    EXPECT_EQ(found.reason, "floor and ceiling");
    EXPECT_EQ(findUp(turned(room(), kYUp), {}).up, Vec3d::UnitY());
    EXPECT_EQ(findUp(turned(room(), kYUp.transpose()), {}).up, -Vec3d::UnitY()) << "as in camera frames";
}

TEST(FindUp, WithoutASurfaceTheCustomOfTheFormatCounts) {
    const FoundUp found = findUp({}, {}, {-Vec3d::UnitY(), false});
    EXPECT_EQ(found.up, -Vec3d::UnitY());
    EXPECT_FALSE(found.reason.empty());
    EXPECT_TRUE(findUp({}, {}).up.isZero());
}

TEST(FindUp, ACeilingIsNoGround) {
    // objects in a room hide its floor, but not its ceiling
    Scene scene;
    scene.addRectangle({0, 0, 2.5}, {6, 0, 0}, {0, 4, 0});
    scene.addRectangle({0, 0, 0}, {6, 0, 0}, {0, 1.9, 0});
    for (const double x : {0.0, 2.4, 4.8}) scene.addRectangle({x, 0.1 * x, 0}, {1, 0, 0}, {0, 0, 2.5}); // the wall
    scene.addBox({1, 1, 0}, {1.6, 0.8, 0.75});
    for (const double x : {0.2, 2.2, 4.2}) scene.addBox({x, 2.2, 0}, {1.4, 2.4, 0.5});
    const FoundUp found = findUp(scene.splats, {});
    EXPECT_EQ(found.up, Vec3d::UnitZ()) << found.up.transpose();
    EXPECT_EQ(found.reason, "floor and ceiling");
}

TEST(FindUp, TiltedScenesStandOnTheirGround) {
    for (const Splats& scene : {room(), groundWithBoxes()}) {
        const FoundUp found = findUp(turned(scene, kTilted), {});
        EXPECT_LT(degreesBetween(found.up, kTilted * Vec3d::UnitZ()), 1) << found.up.transpose() << found.reason;
        EXPECT_NEAR(found.up.norm(), 1, 1e-9);
    }
}

TEST(FindUp, SnapsToANearbyAxis) { EXPECT_EQ(findUp(turned(groundWithBoxes(), kHardlyTilted), {}).up, Vec3d::UnitZ()); }

TEST(FindUp, GroundIsBelowTheObjectsOnIt) {
    const FoundUp found = findUp(groundWithBoxes(), {});
    EXPECT_EQ(found.up, Vec3d::UnitZ());
    EXPECT_EQ(found.reason, "ground");
    EXPECT_EQ(findUp(turned(groundWithBoxes(), kYUp), {}).up, Vec3d::UnitY());
    const Eigen::Matrix3d upside_down(Eigen::AngleAxisd(180 * kDegree, Vec3d::UnitX()));
    EXPECT_EQ(findUp(turned(groundWithBoxes(), upside_down), {}).up, -Vec3d::UnitZ());
}

TEST(FindUp, GuessesZForPointsAndYForMeshes) {
    Scene cube, brick;
    cube.addBox({-1, -1, -1}, {2, 2, 2}, true);
    brick.addBox({-1, -1, -1}, {8, 5, 3}, true);
    for (const Splats& object : {ball(), cube.splats, brick.splats}) {
        EXPECT_EQ(findUp(object, {}).up, Vec3d::UnitZ());
        EXPECT_EQ(findUp(object, {}, {Vec3d::Zero(), true}).up, Vec3d::UnitY());
        EXPECT_EQ(findUp(object, {}).basis, UpBasis::kGuess);
    }
    EXPECT_TRUE(findUp({}, {}).up.isZero());
}

TEST(FindUp, MeshesOfTerrainLieFlat) {
    Scene relief(4000);
    for (int i = 0; i < 10; ++i)
        for (int k = 0; k < 8; ++k)
            relief.addRectangle({0.1 * i, 0.1 * k, 0.05 * ((i + k) % 2)}, {0.1, 0, 0.03}, {0, 0.1, -0.03});
    const UpPrior mesh{Vec3d::Zero(), true};
    EXPECT_EQ(findUp(relief.splats, {}, mesh).up, Vec3d::UnitZ());
    EXPECT_EQ(findUp(turned(relief.splats, kYUp), {}, mesh).up, Vec3d::UnitY());
}

TEST(FindUp, FrontsThatFaceAlongZAreNotOnTheirBack) {
    Scene front(4000); // two walls that meet in an upright edge; their feet and shoulders are uneven
    for (int i = 0; i < 7; ++i) {
        const double foot = 0.1 * (i % 3), size = 1.2 - 0.07 * (i % 4) - foot;
        front.addRectangle({-0.7 + 0.1 * i, foot, 0.1 * i}, {0.1, 0, 0.1}, {0, size, 0});
        front.addRectangle({0.1 * i, foot, 0.7 - 0.1 * i}, {0.1, 0, -0.1}, {0, size, 0});
    }
    EXPECT_EQ(findUp(front.splats, {}).up, Vec3d::UnitY()) << findUp(front.splats, {}).reason;
    EXPECT_EQ(findUp(front.splats, {}).basis, UpBasis::kGuess);
}

TEST(FindUp, FormatsHaveCustoms) {
    const UpPrior z_up{Vec3d::UnitZ(), false};
    EXPECT_EQ(findUp(ball(), {}, z_up).basis, UpBasis::kCustom);
    EXPECT_EQ(findUp(ball(), {}, z_up).up, Vec3d::UnitZ());
    const FoundUp room_of_a_phone = findUp(turned(room(), kYUp), {}, z_up);
    EXPECT_EQ(room_of_a_phone.up, Vec3d::UnitY()) << "the surface overrides the custom";
    EXPECT_EQ(room_of_a_phone.basis, UpBasis::kData);
    Splats on_a_map = turned(room(), kYUp);
    on_a_map.origin = {512'557, 5'403'493, 143};
    EXPECT_EQ(findUp(on_a_map, {}, z_up).up, Vec3d::UnitZ()) << "map coordinates confirm it";
    EXPECT_EQ(findUp(on_a_map, {}, z_up).basis, UpBasis::kCustom);
}

/// A house of two storeys, shifted against each other, with a cellar: neither its ground nor its roof is at one height.
/// z is up.
Splats house() {
    Scene scene;
    scene.addBox({0, 0, 0}, {6, 5, 2.5}, true);
    scene.addBox({3, 2, 2.6}, {6, 6, 2.5}, true);
    scene.addBox({1, 1, -1.5}, {1.5, 1.5, 1.5}, true);
    return scene.splats;
}

TEST(FindUp, BuildingsWithYUpHaveStoreys) {
    EXPECT_EQ(findUp(turned(house(), kYUp), {}).up, Vec3d::UnitY());
    EXPECT_EQ(findUp(turned(house(), kYUp), {}).reason, "floors and ceilings");
    EXPECT_EQ(findUp(house(), {}).up, Vec3d::UnitZ());
    Scene facade, corridor;
    facade.addRectangle({0, 0, 0}, {20, 0, 0}, {0, 0, 9});
    facade.addRectangle({0, -3, 0}, {20, 0, 0}, {0, 3, 0});
    for (int i = 0; i < 6; ++i) facade.addBox({1.0 + 3 * i, -1, 4}, {2, 1, 1});
    corridor.addBox({0, 0, 0}, {12, 1.2, 3}, true);
    for (const Splats& walls : {facade.splats, corridor.splats})
        EXPECT_EQ(findUp(walls, {}).up, Vec3d::UnitZ()) << findUp(walls, {}).reason;
}

TEST(FindUp, NothingStandsOnItsSide) {
    const Eigen::Matrix3d x_up(Eigen::AngleAxisd(90 * kDegree, Vec3d::UnitY()));
    EXPECT_EQ(findUp(turned(ballOnABase(true), x_up), {}).basis, UpBasis::kGuess);
    EXPECT_EQ(findUp(turned(ballOnABase(true), x_up * x_up), {}).up, Vec3d::UnitZ());
}

TEST(FindUp, StatuesStandOnTheirBase) {
    for (const bool closed : {true, false}) {
        const FoundUp found = findUp(turned(ballOnABase(closed), kYUp), {});
        EXPECT_EQ(found.up, Vec3d::UnitY()) << closed;
        EXPECT_EQ(found.reason, "stable base");
        EXPECT_EQ(findUp(ballOnABase(closed), {}).up, Vec3d::UnitZ());
    }
}

TEST(FindUp, CamerasLookAlongTheirOwnAxis) {
    Scene wall(2000);
    wall.addRectangle({-1, -0.7, 3}, {2, 0, 0.5}, {0, 1.4, 0});
    EXPECT_EQ(findUp(wall.splats, scansFrom({Vec3d::Zero()})).up, -Vec3d::UnitY());
    EXPECT_EQ(findUp(wall.splats, {}).basis, UpBasis::kGuess) << "no camera position";
    EXPECT_EQ(findUp(wall.splats, scansFrom({Vec3d(2, 0, 0)})).basis, UpBasis::kGuess) << "another frame";
    const Eigen::Matrix3d behind(Eigen::AngleAxisd(180 * kDegree, Vec3d::UnitX()));
    EXPECT_EQ(findUp(turned(wall.splats, behind), scansFrom({Vec3d::Zero()})).up, Vec3d::UnitY());
}

TEST(FindUp, TurntablesRotateAboutUp) {
    std::vector<Vec3d> around, row;
    for (int i = 0; i < 6; ++i) {
        around.emplace_back(10 * std::cos(i * 60 * kDegree), 1, 10 * std::sin(i * 60 * kDegree));
        row.emplace_back(i, 2, 0.1 * (i % 2));
    }
    EXPECT_EQ(findUp(ball(), scansFrom(around)).up, Vec3d::UnitY());
    EXPECT_EQ(findUp(ball(), scansFrom(row)).basis, UpBasis::kGuess) << "a row is in many planes";
}

TEST(FindUp, MapsHaveZUp) {
    Splats splats = ball();
    splats.origin = {512'557, 5'403'493, 143};
    EXPECT_EQ(findUp(splats, {}).up, Vec3d::UnitZ());
    splats.origin = {0, 143, 5'403'493};
    EXPECT_EQ(findUp(splats, {}).basis, UpBasis::kGuess);
}

} // namespace
} // namespace pointrt
