// SPDX-License-Identifier: Apache-2.0
// Default views of synthetic scenes: where the camera is, and how much of the picture the scene fills.
#include "runtime/scene/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "format/base/error.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/default_view.h"

namespace pointrt {
namespace {

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};
constexpr double kRadiansPerDegree = std::numbers::pi / 180;

class Scene {
public:
    void add(Vec3 position, Vec3 normal, double radius = 0.01) {
        sample.splats.push_back({position, normal, radius, {0.5f, 0.5f, 0.5f}});
    }
    /// Random points of corner + [0, 1] u + [0, 1] v with normals along u x v.
    void addRectangle(Vec3 corner, Vec3 u, Vec3 v, int count) {
        for (int i = 0; i < count; ++i) add(corner + share() * u + share() * v, normalize(cross(u, v)));
    }
    double share() { return std::uniform_real_distribution<double>(0, 1)(random_); }

    SceneSample sample{{}, {}, {}, true, false};

private:
    std::mt19937 random_{1};
};

/// A ball of radius 1, or only its half towards *half.
Scene ball(Vec3 middle = {}, const Vec3* half = nullptr) {
    Scene scene;
    for (int i = 0; i < 6000; ++i) {
        const double z = 2 * scene.share() - 1, angle = 2 * std::numbers::pi * scene.share();
        const Vec3 p{std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z};
        if (!half || dot(p, *half) > 0) scene.add(middle + p, p);
    }
    return scene;
}

/// Ground 40 wide with four boxes; z is up.
Scene site() {
    Scene scene;
    scene.addRectangle({-20, -15, 0}, 40.0 * kX, 30.0 * kY, 6000);
    for (int i = 0; i < 4; ++i) {
        const Vec3 low{-15.0 + 9 * i, -5, 0};
        scene.addRectangle(low + 3.0 * kZ, 4.0 * kX, 4.0 * kY, 200);
        scene.addRectangle(low, 4.0 * kX, 3.0 * kZ, 200);
    }
    return scene;
}

/// A room of 6 x 5 x 2.5 with normals towards its inside; z is up.
Scene room() {
    Scene scene;
    scene.addRectangle({0, 0, 0}, 6.0 * kX, 5.0 * kY, 2000);
    scene.addRectangle({0, 0, 2.5}, 5.0 * kY, 6.0 * kX, 2000);
    scene.addRectangle({0, 0, 0}, 2.5 * kZ, 6.0 * kX, 1000);
    scene.addRectangle({0, 5, 0}, 6.0 * kX, 2.5 * kZ, 1000);
    scene.addRectangle({0, 0, 0}, 5.0 * kY, 2.5 * kZ, 1000);
    scene.addRectangle({6, 0, 0}, 2.5 * kZ, 5.0 * kY, 1000);
    scene.addRectangle({2, 2, 0.8}, 1.5 * kX, 1.0 * kY, 300);
    return scene;
}

struct PictureFrame {
    double left = 1, right = 0, bottom = 1, top = 0; ///< shares of the picture
};

/// The rectangle of the picture around all splats within reach of the origin, so without strays.
PictureFrame frameOf(const SceneSample& sample, const Camera& camera, double aspect, double reach) {
    PictureFrame frame;
    const double tangent = std::tan(camera.fov_deg / 2 * kRadiansPerDegree);
    for (const SampledSplat& splat : sample.splats) {
        if (length(splat.position) > reach) continue;
        const Vec3 to = splat.position - camera.eye;
        const double depth = camera.ortho_height > 0 ? camera.ortho_height / 2 : dot(to, camera.forward) * tangent;
        const double x = (dot(to, camera.right) / (depth * aspect) + 1) / 2, y = (dot(to, camera.up) / depth + 1) / 2;
        frame = {std::min(frame.left, x), std::max(frame.right, x), std::min(frame.bottom, y), std::max(frame.top, y)};
    }
    return frame;
}

Camera completed(const FramedRequest& framed, double aspect) {
    return frameCamera(framed.camera, {-100, -100, -100}, {100, 100, 100}, aspect);
}

TEST(Framing, FillsTheFreePartOfThePicture) {
    Scene scene = ball();
    for (int i = 0; i < 12; ++i) scene.add({40.0 + 5 * i, -30.0 - i, 60}, kY); // strays
    for (const bool ortho : {false, true})
        for (const double aspect : {0.6, 1.0, 16.0 / 9})
            for (const double free_share : {1.0, 0.7}) {
                CameraRequest request;
                request.ortho = ortho;
                const FramedRequest framed = frameScene(request, scene.sample, kY, {aspect, free_share}, true);
                const PictureFrame frame = frameOf(scene.sample, completed(framed, aspect), aspect, 10);
                const double wide = (frame.right - frame.left) / free_share, high = frame.top - frame.bottom;
                EXPECT_GT(std::max(wide, high), 0.75) << aspect << " " << free_share << ortho;
                EXPECT_LT(std::max(wide, high), 0.85) << aspect << " " << free_share << ortho;
                EXPECT_NEAR((frame.left + frame.right) / 2, free_share / 2, 0.02) << aspect << " " << free_share;
                EXPECT_NEAR((frame.bottom + frame.top) / 2, 0.5, 0.02);
            }
}

TEST(Framing, IgnoresManyStrays) {
    Scene scene = ball();
    for (int i = 0; i < 120; ++i) scene.add(300.0 * Vec3{scene.share(), scene.share(), scene.share()}, kY); // 2%
    const PictureFrame frame =
        frameOf(scene.sample, completed(frameScene({}, scene.sample, kY, {1, 1}, true), 1), 1, 5);
    EXPECT_GT(frame.right - frame.left, 0.75);
    EXPECT_LT(frame.right - frame.left, 0.85);
}

/// Expects that the splats within reach of the origin fill and centre a square picture.
void expectFramed(const SceneSample& sample, Vec3 up, double reach) {
    const PictureFrame frame = frameOf(sample, completed(frameScene({}, sample, up, {1, 1}, true), 1), 1, reach);
    const double share = std::max(frame.right - frame.left, frame.top - frame.bottom);
    EXPECT_GT(share, 0.75);
    EXPECT_LT(share, 0.85);
    EXPECT_NEAR((frame.left + frame.right) / 2, 0.5, 0.02);
    EXPECT_NEAR((frame.bottom + frame.top) / 2, 0.5, 0.02);
}

TEST(Framing, KeepsSparseConnectedTips) {
    Scene scene;
    scene.addRectangle({-6, -6, 0}, 12.0 * kX, 12.0 * kY, 8000);
    for (int i = 1; i <= 40; ++i) scene.add({0, 0, 0.4 * i}, kX); // 0.5% of the splats
    expectFramed(scene.sample, kZ, 100);
}

TEST(Framing, DropsSparseFringes) {
    Scene scene;
    scene.addRectangle({-10, -4, 0}, 20.0 * kX, 8.0 * kY, 6000);
    scene.addRectangle({-60, -70, 0}, 120.0 * kX, 60.0 * kY, 100);
    scene.addRectangle({-5, -60, 0}, 10.0 * kX, 3.0 * kZ, 60); // a distant wall
    expectFramed(scene.sample, kZ, 10.8);
}

/// Ground seen by a spinning lidar, where the share of points within a distance is the root of the distance's
/// logarithm, from 1 to 100 m. z is up.
Scene lidarGround() {
    Scene scene;
    for (int i = 0; i < 8000; ++i) {
        const double angle = 2 * std::numbers::pi * scene.share(), distance = std::pow(100, std::pow(scene.share(), 2));
        scene.add({distance * std::cos(angle), distance * std::sin(angle), 0}, kZ);
    }
    return scene;
}

TEST(Framing, CutsThinSurroundingsOfSites) {
    // nine in ten splats are within 100^0.81 = 42 m, where the share grows with the distance's power 0.13
    expectFramed(lidarGround().sample, kZ, 41.7);
    Scene even;
    even.addRectangle({-100, -100, 0}, 200.0 * kX, 200.0 * kY, 8000);
    expectFramed(even.sample, kZ, 200);
    Scene corridor;
    corridor.addRectangle({-100, -5, 0}, 200.0 * kX, 10.0 * kY, 8000);
    expectFramed(corridor.sample, kZ, 200);
}

TEST(Framing, KeepsLargeSeparateParts) {
    Scene scene = ball();
    const Vec3 apart{3, 0, 0};
    for (int i = 0; i < 1000; ++i) scene.add(apart + scene.sample.splats[static_cast<std::size_t>(i)].position, kY);
    expectFramed(scene.sample, kY, 100);
}

TEST(Framing, ShowsWholeDiscsOfTinyScans) {
    for (const bool ortho : {false, true}) {
        Scene scene;
        for (int i = 0; i < 4; ++i) scene.add({double(i % 2), double(i / 2), 0}, kZ, 0.3 + 0.4 * i);
        CameraRequest request;
        request.view = StandardView::kFront;
        request.ortho = ortho;
        const Camera camera = completed(frameScene(request, scene.sample, kY, {1, 1}, true), 1);
        Scene rims;
        for (const SampledSplat& splat : scene.sample.splats)
            for (int degree = 0; degree < 360; ++degree)
                rims.add(splat.position + splat.radius * Vec3{std::cos(degree * kRadiansPerDegree),
                                                              std::sin(degree * kRadiansPerDegree), 0},
                         kZ);
        const PictureFrame frame = frameOf(rims.sample, camera, 1, 100);
        EXPECT_NEAR(std::max(frame.right - frame.left, frame.top - frame.bottom), 0.8, 0.01) << ortho;
        EXPECT_NEAR((frame.left + frame.right) / 2, 0.5, 0.01) << ortho;
        EXPECT_NEAR((frame.bottom + frame.top) / 2, 0.5, 0.01) << ortho;
    }
}

TEST(Framing, TinyScansHaveNoStrays) {
    Scene scene;
    for (int i = 0; i < 15; ++i) scene.add({0, 0, 0.1 * i}, kX);
    for (const Vec3 apart : {Vec3{8, 0, 1}, Vec3{-5, 22, 1}, Vec3{24, 22, 1}}) scene.add(apart, kX);
    expectFramed(scene.sample, kZ, 100);
}

TEST(Framing, DiscBoundsEncloseDiscs) {
    Scene scene;
    scene.add({1, 2, 3}, kZ, 0.5);
    scene.add({2, 2, 3}, normalize(kY + kZ), std::sqrt(2.0));
    const SampleBox discs = discBounds(scene.sample), middles = boundsOf(scene.sample);
    EXPECT_LT(length(discs.low - Vec3{0.5, 1, 2}), 1e-12);
    EXPECT_LT(length(discs.high - Vec3{2 + std::sqrt(2.0), 3, 4}), 1e-12);
    EXPECT_EQ(middles.low, (Vec3{1, 2, 3}));
    EXPECT_EQ(middles.high, (Vec3{2, 2, 3}));
}

TEST(Framing, KeepsGivenEyesAndTargets) {
    CameraRequest eye, target;
    eye.eye = Vec3{3, 0, 0};
    target.target = Vec3{3, 0, 0};
    for (const CameraRequest& request : {eye, target})
        EXPECT_EQ(frameScene(request, ball().sample, kY, {}, true).camera, request);
    Scene has_shapes = ball();
    has_shapes.sample.has_shapes = true;
    EXPECT_EQ(frameScene({}, has_shapes.sample, kY, {}, true).camera, CameraRequest{});
}

TEST(Framing, StandardViewsAreSides) {
    constexpr struct {
        StandardView view;
        Vec3 y_up, z_up; ///< where the eye is
    } kSides[] = {{StandardView::kFront, {0, 0, 1}, {0, -1, 0}}, {StandardView::kBack, {0, 0, -1}, {0, 1, 0}},
                  {StandardView::kRight, {1, 0, 0}, {1, 0, 0}},  {StandardView::kLeft, {-1, 0, 0}, {-1, 0, 0}},
                  {StandardView::kTop, {0, 1, 0}, {0, 0, 1}},    {StandardView::kBottom, {0, -1, 0}, {0, 0, -1}},
                  {StandardView::kIso, {1, 1, 1}, {1, -1, 1}}};
    for (const auto& [view, y_up, z_up] : kSides)
        for (const Vec3 up : {kY, kZ}) {
            CameraRequest request;
            request.view = view;
            const FramedRequest framed = frameScene(request, ball().sample, up, {}, true);
            const Camera camera = completed(framed, 1);
            EXPECT_GT(dot(camera.forward, normalize(up == kY ? y_up : z_up)), -1.001);
            EXPECT_LT(dot(camera.forward, normalize(up == kY ? y_up : z_up)), -0.999)
                << nameOf(kStandardViewNames, view);
            EXPECT_GT(dot(camera.up, upIn(view, up)), 0.5) << nameOf(kStandardViewNames, view);
            EXPECT_FALSE(framed.camera.view);
        }
    EXPECT_GT(dot(upIn(StandardView::kTop, kZ), kY), 0.99) << "north is up on a map";
}

TEST(Framing, StandardViewsApplyToGivenTargets) {
    CameraRequest request;
    request.target = Vec3{0.5, 0.25, 0};
    for (const auto& [name, view] : kStandardViewNames) {
        if (view == StandardView::kSensor) continue;
        request.view = view;
        const Camera camera = completed(frameScene(request, ball().sample, kZ, {}, true), 1);
        EXPECT_GT(dot(camera.forward, -1.0 * sideOf(view, kZ)), 0.999) << name;
        EXPECT_GT(dot(camera.forward, normalize(*request.target - camera.eye)), 0.999999) << name;
        EXPECT_GT(dot(camera.up, upIn(view, kZ)), 0.5) << name;
    }
    Scene scene = room();
    scene.sample.sensors = {{5, 1, 1.5}};
    request.view = StandardView::kSensor;
    const CameraRequest seen = frameScene(request, scene.sample, kZ, {}, true).camera;
    EXPECT_EQ(seen.eye, scene.sample.sensors[0]);
    EXPECT_EQ(seen.target, request.target);
    request.eye = Vec3{0, 0, 9};
    EXPECT_EQ(frameScene(request, scene.sample, kZ, {}, true).camera.eye, request.eye)
        << "a given eye overrides a view";
}

TEST(Framing, SensorViewUsesScannerPositions) {
    CameraRequest request;
    request.view = StandardView::kSensor;
    try {
        frameScene(request, ball().sample, kY, {}, true);
        ADD_FAILURE() << "no scanner position is known";
    } catch (const Error& error) {
        EXPECT_EQ(error.code, ExitCode::kBadUsage);
    }
    Scene scene = room();
    scene.sample.sensors = {{5, 1, 1.5}};
    EXPECT_EQ(frameScene(request, scene.sample, kZ, {}, true).camera.eye, scene.sample.sensors[0]);
}

TEST(DefaultView, ObjectsFromTheFrontHorizontally) {
    EXPECT_EQ(chooseView(ball().sample, kY).side, kZ);
    EXPECT_EQ(chooseView(ball().sample, kZ).side, -1.0 * kY);
}

TEST(DefaultView, FromTheSideThatWasScanned) {
    const Vec3 behind{0, 0, -1}, left{-1, 0, 0};
    for (const Vec3 side : {behind, left}) {
        const ViewChoice choice = chooseView(ball({}, &side).sample, kY);
        EXPECT_GT(dot(choice.side, side), 0.99);
        EXPECT_FALSE(choice.eye);
    }
}

TEST(DefaultView, SitesFromThreeQuartersAbove) {
    const ViewChoice choice = chooseView(site().sample, kZ);
    EXPECT_NEAR(std::asin(choice.side.z) / kRadiansPerDegree, 35, 1);
    EXPECT_LT(choice.side.y, -0.3) << "from the front";
    EXPECT_FALSE(choice.eye);
}

/// Floor and walls of 9 x 7 x 3 without a ceiling, scanned from inside. share: the part of each wall that is there.
Scene walled(double share) {
    Scene scene;
    scene.addRectangle({0, 0, 0}, 9.0 * kX, 7.0 * kY, 2000);
    scene.addRectangle({0, 0, 0}, 3.0 * kZ, 9.0 * share * kX, 1500);
    scene.addRectangle({0, 7, 0}, 9.0 * share * kX, 3.0 * kZ, 1500);
    scene.addRectangle({0, 0, 0}, 7.0 * share * kY, 3.0 * kZ, 1000);
    scene.addRectangle({9, 0, 0}, 3.0 * kZ, 7.0 * share * kY, 1000);
    return scene;
}

TEST(DefaultView, WallsWithoutACeilingFromAbove) {
    const ViewChoice choice = chooseView(walled(1).sample, kZ);
    EXPECT_NEAR(std::asin(choice.side.z) / kRadiansPerDegree, 50, 1);
    EXPECT_FALSE(choice.eye);
    EXPECT_LT(std::asin(chooseView(walled(0.3).sample, kZ).side.z) / kRadiansPerDegree, 36) << "open on all sides";
}

TEST(DefaultView, RoomsFromInside) {
    for (const bool oriented : {true, false})
        for (const bool known : {true, false}) {
            Scene scene = room();
            scene.sample.oriented = oriented;
            if (known) scene.sample.sensors = {{1, 1, 1.5}, {5, 4, 1.5}, {200, 0, 0}};
            const ViewChoice choice = chooseView(scene.sample, kZ);
            ASSERT_TRUE(choice.eye) << oriented << known;
            const Vec3 eye = *choice.eye;
            EXPECT_TRUE(eye.x > 0 && eye.x < 6 && eye.y > 0 && eye.y < 5 && eye.z > 0 && eye.z < 2.5);
            double nearest = std::numeric_limits<double>::infinity();
            for (const SampledSplat& splat : scene.sample.splats)
                nearest = std::min(nearest, length(splat.position - eye));
            EXPECT_GT(nearest, 0.4) << "something is too near";
        }
}

/// Walls of 6 x 4.5 x height, either scanned from one place at eye level, where more distant points are sparser and
/// have larger discs, or evenly. z is up.
Scene shell(double height, bool even) {
    Scene scene;
    scene.addRectangle({0, 0, 0}, 6.0 * kX, 4.5 * kY, 1500);
    scene.addRectangle({0, 0, height}, 6.0 * kX, 4.5 * kY, 1500);
    scene.addRectangle({0, 0, 0}, 6.0 * kX, height * kZ, 800);
    scene.addRectangle({0, 4.5, 0}, 6.0 * kX, height * kZ, 800);
    scene.addRectangle({0, 0, 0}, 4.5 * kY, height * kZ, 600);
    scene.addRectangle({6, 0, 0}, 4.5 * kY, height * kZ, 600);
    for (SampledSplat& splat : scene.sample.splats) {
        const double away = length(splat.position - Vec3{2, 2.2, height / 2});
        splat.radius = even ? 0.1 : 0.03 * away * away;
    }
    scene.sample.oriented = false;
    return scene;
}

TEST(DefaultView, EmptyRoomsFromInside) {
    const Vec3 centre{3, 2.25, 1.35};
    const std::optional<Vec3> eye = chooseView(shell(2.7, false).sample, kZ).eye;
    ASSERT_TRUE(eye);
    EXPECT_LT(length(*eye - centre), 2.5);
    EXPECT_FALSE(chooseView(shell(2.7, true).sample, kZ).eye) << "a model of a box";
    EXPECT_FALSE(chooseView(shell(0.3, false).sample, kZ).eye) << "too low for a room";
}

TEST(DefaultView, EyesInBuildingsAreWithinAStorey) {
    Scene house = room();
    for (const SampledSplat& splat : room().sample.splats)
        house.add(splat.position + Vec3{0, 0, 2.8}, splat.normal, splat.radius);
    house.addRectangle({0, 0, 5.6}, 6.0 * kX, 5.0 * kY, 2000);
    const std::optional<Vec3> eye = chooseView(house.sample, kZ).eye;
    ASSERT_TRUE(eye);
    const double above_floor = eye->z > 2.8 ? eye->z - 2.8 : eye->z;
    EXPECT_GT(above_floor, 1);
    EXPECT_LT(above_floor, 2.3);
}

TEST(Framing, EyesWithinWallsKnowTheirSurrounding) {
    const SceneSample room = shell(2.7, false).sample;
    CameraRequest request;
    request.eye = Vec3{2, 2.2, 1.35};
    const FramedRequest inside = frameScene(request, room, kZ, {1, 1}, true);
    EXPECT_EQ(inside.camera.eye, request.eye);
    ASSERT_TRUE(inside.walls);
    EXPECT_TRUE(inside.within);
    EXPECT_NEAR(inside.walls->headroom, 1.35, 0.1);
    EXPECT_GT(inside.walls->covered, 0.75);
    request.eye = Vec3{2, -9, 1.35};
    EXPECT_FALSE(frameScene(request, room, kZ, {1, 1}, true).walls) << "outside";
    SceneSample court = room;
    std::erase_if(court.splats, [](const SampledSplat& splat) { return splat.position.z > 2.69; });
    request.eye = Vec3{2, 2.2, 1.35};
    EXPECT_FALSE(frameScene(request, court, kZ, {1, 1}, true).within) << "lamps shine in through the open top";
}

TEST(Framing, TellsPlacesFromObjects) {
    EXPECT_EQ(kindOfPlace(room().sample, kZ, false), PlaceKind::kRoom);
    EXPECT_EQ(kindOfPlace(site().sample, kZ, false), PlaceKind::kSite);
    EXPECT_EQ(kindOfPlace(ball().sample, kZ, false), PlaceKind::kObject);
    EXPECT_EQ(kindOfPlace(ball().sample, kZ, true), PlaceKind::kObject) << "a tree";
    Scene canopy; // no ground is visible
    for (int i = 0; i < 6000; ++i)
        canopy.add({40 * canopy.share(), 40 * canopy.share(), 6 * canopy.share()},
                   normalize(Vec3{canopy.share() - 0.5, canopy.share() - 0.5, canopy.share() - 0.5}));
    EXPECT_EQ(kindOfPlace(canopy.sample, kZ, true), PlaceKind::kSite);
    EXPECT_EQ(kindOfPlace(canopy.sample, kZ, false), PlaceKind::kObject);
}

TEST(SceneSample, LowestPointAlongATiltedUp) {
    const Vec3 up = normalize(Vec3{1, 0, 1});
    EXPECT_NEAR(lowestIfTilted(ball().sample, up).value(), -1, 0.02) << "the corner of its box is at -1.41";
    EXPECT_FALSE(lowestIfTilted({}, up));
    EXPECT_FALSE(lowestIfTilted(ball().sample, kZ));
}

TEST(SceneSample, MeansOfReflectance) {
    Scene scene;
    scene.add({}, kZ);
    scene.add({1, 0, 0}, kZ);
    scene.sample.splats[0].color = {1, 1, 1};
    scene.sample.splats[1].color = {0, 0, 0};
    EXPECT_NEAR(meanReflectance(scene.sample), 0.5, 1e-6);
    EXPECT_EQ(meanReflectance({}), 0.5);
}

/// Whether a cupboard from (2.5, 1.8) to (3.5, 3.2), as high as the room, is between eye and place.
bool isBehindCupboard(Vec3 eye, Vec3 place) {
    for (int step = 1; step < 200; ++step) {
        const Vec3 p = eye + step / 200.0 * (place - eye);
        if (p.x > 2.51 && p.x < 3.49 && p.y > 1.81 && p.y < 3.19) return true;
    }
    return false;
}

TEST(DefaultView, RoomsFromAnUnrecordedScannerPosition) {
    const Vec3 stood{0.8, 0.9, 1.3};
    Scene scene = room();
    scene.addRectangle({2.5, 1.8, 0}, 1.4 * kY, 2.5 * kZ, 500);
    scene.addRectangle({2.5, 1.8, 0}, 1.0 * kX, 2.5 * kZ, 400);
    std::erase_if(scene.sample.splats, [&](const SampledSplat& s) { return isBehindCupboard(stood, s.position); });
    scene.sample.zeros = {{20, 0, 0}, stood};
    EXPECT_EQ(chooseView(scene.sample, kZ).eye, stood) << "all splats are visible from there";
    scene.sample.zeros = {{5.2, 4.1, 1.3}};
    EXPECT_NE(chooseView(scene.sample, kZ).eye, scene.sample.zeros[0]) << "it would have scanned the other sides";
}

TEST(DefaultView, NoEyeIsInADisc) {
    Scene scene;
    for (int i = 0; i < 4; ++i) scene.add({double(i % 2), double(i / 2), 0}, kZ, 0.85);
    scene.sample.sensors = {{-0.5, 0.5, 0.05}}; // beside the discs
    EXPECT_FALSE(chooseView(scene.sample, kZ).eye);
    scene.sample.sensors = {{0.5, 0.5, 3}};
    EXPECT_TRUE(chooseView(scene.sample, kZ).eye);
}

TEST(DefaultView, NoObstacleIsInFrontOfTheEye) {
    Scene scene = room();
    const std::optional<Vec3> free = chooseView(scene.sample, kZ).eye;
    ASSERT_TRUE(free);
    scene.add(*free + Vec3{1, 0, 0}, kZ, 1.2); // its centre is as far as the walls
    const std::optional<Vec3> eye = chooseView(scene.sample, kZ).eye;
    ASSERT_TRUE(eye);
    EXPECT_GT(length(*eye - scene.sample.splats.back().position), 1.3);
}

TEST(DefaultView, StatuesAreNotSeenFromInside) {
    Scene scene = ball();
    scene.sample.sensors = {{0, 0, 4}, {4, 0, 0}, {0, 0, -4}, {-4, 0, 0}};
    EXPECT_FALSE(chooseView(scene.sample, kY).eye);
}

TEST(DefaultView, RangeImagesFromTheirScanner) {
    Scene scene;
    scene.addRectangle({-2, -1.5, -3}, 4.0 * kX, 3.0 * kY, 4000);
    scene.sample.sensors = {{0, 0, 0}};
    const FramedRequest framed = frameScene({}, scene.sample, kY, {4.0 / 3, 1}, true);
    EXPECT_EQ(framed.camera.eye, Vec3{});
    EXPECT_TRUE(framed.within);
    EXPECT_GT(framed.camera.fov_deg, 40) << "the scanner's field of view is wider than the default";
    const PictureFrame frame = frameOf(scene.sample, completed(framed, 4.0 / 3), 4.0 / 3, 10);
    EXPECT_NEAR(frame.right - frame.left, 0.8, 0.05);
    const FramedRequest fixed = frameScene({}, scene.sample, kY, {4.0 / 3, 1}, false);
    EXPECT_EQ(fixed.camera.fov_deg, 40);
    EXPECT_GT(fixed.camera.eye.value().z, 0.5) << "farther back, so that all of it is visible";
}

/// What a scanner at the origin sees along x: ground and a wall, with discs as wide as the distance between its rays.
Scene frameFromOrigin() {
    Scene scene;
    scene.addRectangle({3, -4, -1.5}, 17.0 * kX, 8.0 * kY, 3000);
    scene.addRectangle({20, -4, -1.5}, 4.0 * kZ, 8.0 * kY, 1500);
    for (SampledSplat& splat : scene.sample.splats) splat.radius = 0.005 * length(splat.position);
    scene.sample.zeros = {{0, 0, 0}};
    return scene;
}

TEST(DefaultView, FramesFromAnUnrecordedScannerAtTheOrigin) {
    Scene frame = frameFromOrigin();
    EXPECT_EQ(chooseView(frame.sample, kZ).eye, Vec3{});
    Scene even = frameFromOrigin();
    for (SampledSplat& splat : even.sample.splats) splat.radius = 0.05;
    EXPECT_FALSE(chooseView(even.sample, kZ).eye) << "discs of a model do not grow with their distance";
    Scene turned = frameFromOrigin();
    for (SampledSplat& splat : turned.sample.splats) splat.normal = -1.0 * splat.normal;
    EXPECT_FALSE(chooseView(turned.sample, kZ).eye) << "no scanner sees backs";
}

TEST(Framing, SurvivesOneSplat) {
    Scene scene;
    scene.add({1, 2, 3}, kY);
    for (const bool ortho : {false, true}) {
        CameraRequest request;
        request.ortho = ortho;
        const FramedRequest framed = frameScene(request, scene.sample, kY, {}, true);
        EXPECT_TRUE(std::isfinite(length(framed.camera.target.value())));
        EXPECT_NO_THROW(completed(framed, 1));
    }
}

} // namespace
} // namespace pointrt
