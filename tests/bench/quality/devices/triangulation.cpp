// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include <limits>
#include <numbers>

#include "tests/bench/quality/devices/devices.h"

namespace pointrt::quality {

namespace {

using std::numbers::pi;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// Number of lines of light that represent the sheet's width.
constexpr int kLines = 9;

/// One scan: the sheet moves along x, light goes along -z, the camera is between z and x.
struct Stripe {
    const WorldTracing& world;
    const Triangulation& device;
    Eigen::Isometry3d world_from_device;
    double radius;

    double angle() const { return device.angle_deg * pi / 180; }
    Vec3d toCamera() const { return {std::sin(angle()), 0, std::cos(angle())}; }

    /// Position and brightness of a line of light in the camera's view; nullopt if it is hidden.
    struct Seen {
        double image, power;
    };
    std::optional<Seen> lineAt(double x, double y) const {
        const Vec3d start = world_from_device * Vec3d(x, y, 2 * radius),
                    down = world_from_device.linear() * -Vec3d::UnitZ();
        const auto hit = world.firstHit(start, down);
        if (!hit) return std::nullopt;
        const double z = 2 * radius - hit->range;
        const Vec3d camera = world_from_device.linear() * toCamera();
        // offset by a thousandth of the object, to avoid self-intersection
        const Vec3d place = start + hit->range * down + 1e-3 * radius * hit->normal;
        if (camera.dot(hit->normal) <= 0 || !world.isFree(place, place + 4 * radius * camera)) return std::nullopt;
        return Seen{x * std::cos(angle()) - z * std::sin(angle()), hit->cosine};
    }

    /// The brightest stripe in view; light further apart than the sheet's width is another stripe.
    Vec3d sampleAt(double x, double y, double error) const {
        double whole = 0, last = 0;
        Seen stripe{0, 0}, strongest{0, 0}; // images are sums of light, weighted by power
        for (int i = 0; i < kLines; ++i) {
            const double offset = device.half_width * (2.0 * i / (kLines - 1) - 1);
            const double light = std::exp(-2 * offset * offset / (device.half_width * device.half_width));
            whole += light;
            const auto seen = lineAt(x + offset, y);
            if (!seen || std::abs(seen->image - last) > device.half_width) stripe = {0, 0};
            if (!seen) continue;
            last = seen->image;
            stripe.power += light * seen->power;
            stripe.image += light * seen->power * seen->image;
            if (stripe.power > strongest.power) strongest = stripe;
        }
        if (strongest.power < device.least_power * whole) return Vec3d::Constant(kNan);
        const double z = (x * std::cos(angle()) - strongest.image / strongest.power) / std::sin(angle());
        return {x, y, z + error};
    }

    GridScan scan(std::uint64_t seed) const {
        const auto side = static_cast<std::size_t>(2 * radius / device.pitch);
        GridScan scan{side, side, std::vector<Vec3d>(side * side), world_from_device};
        tbb::parallel_for(std::size_t{0}, scan.samples.size(), [&](std::size_t i) {
            Random random(seed, i);
            const auto at = [&](std::size_t step) { return static_cast<double>(step) * device.pitch - radius; };
            scan.samples[i] = sampleAt(at(i % side), at(i / side), device.noise * random.normal());
        });
        return scan;
    }
};

/// The true pose of the turntable, near the one written to the file.
Eigen::Isometry3d disturbed(const Eigen::Isometry3d& pose, const Triangulation& device, Random& random) {
    const auto vector = [&](double size) {
        return Vec3d(size * Vec3d(random.normal(), random.normal(), random.normal()));
    };
    Eigen::Isometry3d moved = pose;
    const Vec3d turn = vector(device.pose_turn_deg * pi / 180 / std::sqrt(3.0));
    moved.prerotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
    moved.translation() += vector(device.pose_offset);
    return moved;
}

} // namespace

std::vector<GridScan> scanByTriangulation(const WorldTracing& world, const Triangulation& device, double radius,
                                          std::uint64_t seed) {
    constexpr int kAround = 6, kAbove = 2;
    std::vector<GridScan> scans;
    for (int i = 0; i < kAround + kAbove; ++i) {
        const bool above = i >= kAround;
        Random random(seed, static_cast<std::uint64_t>(i));
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        pose.rotate(Eigen::AngleAxisd(2 * pi * i / (above ? kAbove : kAround), Vec3d::UnitY()));
        if (above) pose.rotate(Eigen::AngleAxisd(-pi / 4, Vec3d::UnitX()));
        scans.push_back(Stripe{world, device, disturbed(pose, device, random), radius}.scan(
            seed + 1 + static_cast<std::uint64_t>(i)));
        scans.back().world_from_device = pose;
    }
    return scans;
}

} // namespace pointrt::quality
