// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/degrees.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "preprocess/ingest/notes.h"

namespace pointrt {
namespace {

/// Semi-major axis in metres and flattening of WGS 84.
constexpr double kEarthRadius = 6378137, kFlattening = 1 / 298.257223563;

bool areDegrees(const Eigen::AlignedBox3d& box) {
    constexpr double kMostEast = 360, kMostNorth = 90; // 0 to 360 east, or -180 to 180
    return box.min().y() >= -kMostNorth && box.max().y() <= kMostNorth && box.min().x() >= -kMostEast &&
           box.max().x() <= kMostEast;
}

} // namespace

Eigen::Vector2d metresPerDegree(double latitude) {
    constexpr double kSquare = kFlattening * (2 - kFlattening); // squared eccentricity
    constexpr double kDegree = std::numbers::pi / 180;
    const double sine = std::sin(latitude * kDegree), flat = 1 - kSquare * sine * sine;
    const double across = kEarthRadius / std::sqrt(flat), along = across * (1 - kSquare) / flat;
    return kDegree * Eigen::Vector2d(across * std::cos(latitude * kDegree), along);
}

bool scaleDegrees(Cloud& cloud, const std::string& file) {
    Eigen::AlignedBox3d box;
    for (const Vec3f& position : cloud.positions) box.extend(cloud.origin + position.cast<double>());
    if (!areDegrees(box)) {
        addNote(
            cloud, file,
            "declares a coordinate system in degrees, but its coordinates are not degrees: they are kept unchanged");
        return false;
    }
    const Vec3d middle(box.center().x(), box.center().y(), 0);
    Vec3d metres(1, 1, 1);
    metres.head<2>() = metresPerDegree(middle.y());
    const Vec3d origin(0, 0, cloud.origin.z());
    const auto scaled = [&](const Vec3d& place) { return Vec3d((place - middle).cwiseProduct(metres)); };
    const auto move = [&](Vec3f& place) {
        place = (scaled(cloud.origin + place.cast<double>()) - origin).cast<float>();
    };
    for (Vec3f& position : cloud.positions) move(position);
    for (Vec3f& sensor : cloud.sensors) move(sensor);
    for (Scan& scan : cloud.scans)
        if (scan.sensor) scan.sensor = scaled(*scan.sensor);
    cloud.origin = origin;
    cloud.world.metres_per_unit = 1;
    cloud.world.up = Vec3d::UnitZ();
    cloud.world.crs.clear();
    addNote(cloud, file,
            fmt::format(
                "is in degrees: x and y are converted to metres around {:.7f}, {:.7f}, where a degree is {:.3f} and "
                "{:.3f} m; any --transform, even the identity, keeps degrees",
                middle.x(), middle.y(), metres.x(), metres.y()));
    return true;
}

} // namespace pointrt
