// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include <limits>
#include <numbers>

#include "tests/bench/quality/devices/devices.h"

namespace pointrt::quality {

namespace {

using std::numbers::pi;

/// A point of the surface.
struct Patch {
    Vec3d position, normal;
};

/// A random point of a triangle (Turk, "Generating random points in triangles", Graphics Gems 1990).
Patch patchOf(const Mesh& mesh, std::uint32_t triangle, Random& random) {
    const double s = std::sqrt(random.uniform()), t = random.uniform();
    return {(1 - s) * mesh.corner(triangle, 0) + s * (1 - t) * mesh.corner(triangle, 1) +
                s * t * mesh.corner(triangle, 2),
            mesh.faceNormal(triangle).normalized()};
}

std::vector<Patch> patchesOver(const Mesh& mesh, double pitch, std::uint64_t seed) {
    std::vector<Patch> patches;
    Random random(seed);
    double owed = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        for (owed += mesh.faceNormal(i).norm() / 2 / (pitch * pitch); owed >= 1; --owed)
            patches.push_back(patchOf(mesh, i, random));
    return patches;
}

/// A ring of cameras around the vertical axis, slightly above the object, and another one higher up.
std::vector<Vec3d> camerasAround(const Photogrammetry& device) {
    std::vector<Vec3d> cameras;
    for (int i = 0; i < device.cameras; ++i) {
        const double around = 2 * pi * i / device.cameras, height = i % 2 ? 0.9 : 0.2;
        cameras.push_back(4 * device.longest * Vec3d(std::cos(around), height, std::sin(around)));
    }
    return cameras;
}

/// Whether the object has no texture to match there: a threshold of waves of a tenth of its size.
bool isBare(const Vec3d& place, const Photogrammetry& device) {
    const Vec3d at = place * (2 * pi / (0.1 * device.longest));
    const double paint =
        std::sin(at.x() + 0.7 * at.y()) * std::sin(at.y() - 0.4 * at.z()) * std::sin(at.z() + 0.3 * at.x());
    // the product of three sines is above 1 - 2 p at about p / 2 of all places, for small p
    return (paint + 1) / 2 > 1 - 2 * device.bare_share;
}

} // namespace

std::vector<Vec3d> scanByPhotogrammetry(const WorldTracing& world, const Photogrammetry& device, std::uint64_t seed) {
    const std::vector<Patch> patches = patchesOver(world.world().mesh, device.pitch, seed);
    const std::vector<Vec3d> cameras = camerasAround(device);
    const double least_cosine = std::cos(device.largest_slope_deg * pi / 180);
    std::vector<Vec3d> points(patches.size(), Vec3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t i) {
        Random random(seed + 1, i);
        const Patch& patch = patches[i];
        if (isBare(patch.position, device)) return;
        int views = 0;
        double best = least_cosine;
        Vec3d sight = Vec3d::Zero();
        for (const Vec3d& camera : cameras) {
            const Vec3d to = (camera - patch.position).normalized();
            const double cosine = to.dot(patch.normal);
            if (cosine < least_cosine || !world.isFree(patch.position + 1e-4 * device.longest * patch.normal, camera))
                continue;
            ++views;
            if (cosine > best) {
                best = cosine;
                sight = to;
            }
        }
        if (views < device.least_views) return;
        const bool stray = random.uniform() < device.stray_share;
        const double along = stray ? device.longest / 2 * random.between(-1, 1) : device.noise * random.normal();
        const Vec3d aside = device.lateral_noise * Vec3d(random.normal(), random.normal(), random.normal());
        points[i] = patch.position + along * sight + aside;
    });
    std::erase_if(points, [](const Vec3d& point) { return !isTaken(point); });
    return points;
}

} // namespace pointrt::quality
