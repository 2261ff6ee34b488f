// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/devices/cases.h"

namespace pointrt::quality {

namespace {

constexpr int kSize = 512; // pixels per row and column

/// A mesh of the data folder, scaled to this length.
auto model(const char* file, double longest, bool z_up) {
    return [=](const std::string& data) { return modelWorld(data + "/" + file, longest, z_up); };
}

auto madeScene(World (*scene)(int), int variant) {
    return [=](const std::string&) { return scene(variant); };
}

Eigen::AlignedBox3f boundsOf(const World& world) {
    Eigen::AlignedBox3f box;
    for (const Vec3f& position : world.mesh.positions) box.extend(position);
    return box;
}

DeviceCase triangulation(const char* subject, const char* file, bool held_out) {
    DeviceCase row{"triangulation", subject, held_out, model(file, 0.2, false), {}, {}, 0.0012, 0.001};
    row.scan = [](const WorldTracing& world, const std::string& folder) {
        const double radius = boundsOf(world.world()).diagonal().norm() / 2;
        writeConf(folder, scanByTriangulation(world, {}, radius, 1));
        return folder + "/scan.conf";
    };
    row.cameras = {{{0.05, 0.1, 0.5}, {0, 0, 0}, Vec3d::UnitY(), 30, kSize},
                   {{-0.4, 0.1, 0.3}, {0, 0, 0}, Vec3d::UnitY(), 30, kSize}};
    return row;
}

/// The camera is in the room and looks slightly down at the table; the far corner is out of range.
Eigen::Isometry3d frameOfDepthCamera() {
    const Vec3d eye(1.0, 0.9, 1.5), ahead = (Vec3d(4.5, 2.8, 0.8) - eye).normalized();
    const Vec3d right = ahead.cross(Vec3d::UnitZ()).normalized();
    Eigen::Isometry3d world_from_camera = Eigen::Isometry3d::Identity();
    world_from_camera.linear() << right, ahead.cross(right), ahead;
    world_from_camera.translation() = eye;
    return world_from_camera.inverse();
}

DeviceCase depthCamera(const char* subject, int variant, bool held_out) {
    DeviceCase row{"depth_camera", subject, held_out, {}, {}, {}, 0.05, 0.05};
    row.world = [variant](const std::string&) { return transformed(roomWorld(variant), frameOfDepthCamera()); };
    row.scan = [](const WorldTracing& world, const std::string& folder) {
        writeOrganizedPcd(folder + "/scan.pcd", scanByDepthCamera(world, {}, 2));
        return folder + "/scan.pcd";
    };
    row.cameras = {{{0, 0, 0}, {0, 0, 2.5}, -Vec3d::UnitY(), 40, kSize},
                   {{0.4, -0.3, 0.2}, {0, 0.1, 2.5}, -Vec3d::UnitY(), 40, kSize}};
    return row;
}

DeviceCase terrestrial(const char* subject, int variant, bool held_out) {
    DeviceCase row{"terrestrial", subject, held_out, madeScene(houseWorld, variant), {}, {}, 0.03, 0.15};
    row.scan = [](const WorldTracing& world, const std::string& folder) {
        writePtx(folder + "/scan.ptx",
                 {scanByTerrestrial(world, {}, {-9, -16, 1.7}, 3), scanByTerrestrial(world, {}, {16, 10, 1.7}, 5)});
        return folder + "/scan.ptx";
    };
    row.cameras = {{{-18, -20, 6}, {0, 0, 3}, Vec3d::UnitZ(), 40, kSize},
                   {{21, 13, 8}, {0, 0, 3}, Vec3d::UnitZ(), 40, kSize}};
    return row;
}

DeviceCase airborne(const char* subject, World (*scene)(int), int variant, bool held_out) {
    DeviceCase row{"airborne", subject, held_out, madeScene(scene, variant), {}, {}, 0.2, 0.6};
    row.scan = [](const WorldTracing& world, const std::string& folder) {
        writeLas(folder + "/scan.las", scanByAirborne(world, {}, 22, 7));
        return folder + "/scan.las";
    };
    row.cameras = {{{-30, -42, 40}, {0, 0, 2}, Vec3d::UnitZ(), 40, kSize},
                   {{42, -28, 45}, {0, 0, 2}, Vec3d::UnitZ(), 40, kSize}};
    return row;
}

DeviceCase spinning(const char* subject, int variant, bool held_out) {
    DeviceCase row{"spinning", subject, held_out, madeScene(streetWorld, variant), {}, {}, 0.08, 0.4};
    row.scan = [](const WorldTracing& world, const std::string& folder) {
        std::vector<Vec3d> places;
        for (double x = -15; x <= 15; x += 3) places.emplace_back(x, -0.5, 2);
        writePly(folder + "/scan.ply", scanBySpinning(world, {}, places, 9));
        return folder + "/scan.ply";
    };
    row.cameras = {{{-18, -1, 2.2}, {10, 3, 3}, Vec3d::UnitZ(), 60, kSize},
                   {{16, 0.5, 5}, {-10, -5, 2}, Vec3d::UnitZ(), 60, kSize}};
    return row;
}

DeviceCase photogrammetry(const char* subject, const char* file, bool held_out) {
    DeviceCase row{"photogrammetry", subject, held_out, model(file, Photogrammetry{}.longest, true), {}, {},
                   0.0012,           0.001};
    row.scan = [](const WorldTracing& world, const std::string& folder) {
        writePly(folder + "/scan.ply", scanByPhotogrammetry(world, {}, 20));
        return folder + "/scan.ply";
    };
    row.cameras = {{{0.05, 0.08, 0.4}, {0, 0, 0}, Vec3d::UnitY(), 30, kSize},
                   {{-0.32, 0.08, 0.24}, {0, 0, 0}, Vec3d::UnitY(), 30, kSize}};
    return row;
}

} // namespace

std::vector<DeviceCase> deviceCases() {
    return {triangulation("dragon", "stanford_models/dragon_vrip_res2.ply", false),
            triangulation("bunny", "stanford_bunny_recon/bun_zipper.ply", true),
            depthCamera("room1", 1, false),
            depthCamera("room2", 2, true),
            terrestrial("house1", 1, false),
            terrestrial("house2", 2, true),
            airborne("house1", houseWorld, 1, false),
            airborne("street2", streetWorld, 2, true),
            spinning("street1", 1, false),
            spinning("street2", 2, true),
            photogrammetry("lucy", "stanford_models/Lucy100k.ply", false),
            photogrammetry("nefertiti", "stanford_models/nefertiti.obj", true)};
}

} // namespace pointrt::quality
