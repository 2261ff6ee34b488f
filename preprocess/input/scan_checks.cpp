// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/scan_checks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "preprocess/ingest/notes.h"
#include "preprocess/input/mesh/mesh.h"

namespace pointrt {
namespace {

/// Diagonal of the box around the middle 80 % of each coordinate, of a thousand points: strays do not count.
double middleSize(const Cloud& cloud, const ScanRange& scan) {
    constexpr std::size_t kPoints = 1000;
    const std::size_t count = std::min(scan.position_count, kPoints);
    Vec3d size = Vec3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<float> values(count);
        for (std::size_t i = 0; i < count; ++i)
            values[i] = cloud.positions[scan.first_position + i * scan.position_count / count][axis];
        std::sort(values.begin(), values.end());
        if (count > 0) size[axis] = double(values[count - 1 - count / 10]) - double(values[count / 10]);
    }
    return size.norm();
}

/// A thousandth of a degree is 50 to 111 m long: a scan with 1 m of relief for each 100 m is 900 times higher than
/// wide. Upright wires and masts in metres are less than 100 times.
constexpr double kSlender = 100;

bool isLongitudeLatitude(const Vec3d& position) {
    constexpr double kMostEast = 360, kMostNorth = 90; // west of Greenwich is negative or beyond 180
    return std::abs(position.x()) <= kMostEast && std::abs(position.y()) <= kMostNorth;
}

double widthOf(const Eigen::AlignedBox3d& box) { return std::max(box.sizes().x(), box.sizes().y()); }

/// Whether a box is too wide for its distance from the meridian and the equator; if so, all larger boxes around it are.
bool isTooWide(const Eigen::AlignedBox3d& box) {
    const double reach = std::max(box.min().head<2>().cwiseAbs().maxCoeff(), box.max().head<2>().cwiseAbs().maxCoeff());
    return kSlender * widthOf(box) > reach;
}

} // namespace

void dropNoData(Sink& sink) {
    // corners of removed faces are stored as indices of points, which would change
    if (sink.no_data.empty() || !sink.cornersOfRemovedFaces().empty()) return;
    Cloud& cloud = sink.cloud;
    std::vector<bool> keep(cloud.positions.size(), true);
    for (const ScanNoData& each : sink.no_data) {
        const ScanRange& scan = sink.scans[each.scan];
        for (std::size_t i = scan.first_position; i < scan.first_position + scan.position_count; ++i)
            if (each.points.marks(each.scan_from_world * (cloud.origin + cloud.positions[i].cast<double>())))
                keep[i] = false;
    }
    std::size_t kept = 0;
    for (ScanRange& scan : sink.scans) {
        const auto first = keep.begin() + static_cast<std::ptrdiff_t>(scan.first_position);
        scan.first_position = kept;
        scan.position_count =
            static_cast<std::size_t>(std::count(first, first + static_cast<std::ptrdiff_t>(scan.position_count), true));
        kept += scan.position_count;
    }
    cloud.points_no_data += cloud.positions.size() - kept;
    keepPoints(cloud, keep);
}

bool looksLikeDegrees(const Eigen::AlignedBox3d& box) {
    if (box.isEmpty() || !isLongitudeLatitude(box.min()) || !isLongitudeLatitude(box.max())) return false;
    const double width = widthOf(box);
    // the corner of a small scan in metres is at its origin, whereas places on the Earth are seldom on the equator
    const double away = box.center().head<2>().cwiseAbs().maxCoeff();
    return width > 0 && box.sizes().z() > kSlender * width && away > kSlender * width;
}

bool looksLikeDegrees(const Cloud& cloud, std::span<const ScanRange> scans) {
    Eigen::AlignedBox3d box;
    for (const ScanRange& scan : scans)
        for (std::size_t i = 0; i < scan.position_count; ++i) {
            const Vec3d position = cloud.origin + cloud.positions[scan.first_position + i].cast<double>();
            box.extend(position);
            // for scans in metres, the first few points show that
            if (!isLongitudeLatitude(position) || isTooWide(box)) return false;
        }
    return looksLikeDegrees(box);
}

void noteUnits(Sink& sink) {
    constexpr double kLeast = 500, kMost = 2000; // limits of a factor of about a thousand
    const ScanRange *smallest = nullptr, *largest = nullptr;
    double small = 0, large = 0;
    for (const ScanRange& scan : sink.scans) {
        const double size = middleSize(sink.cloud, scan);
        if (!(size > 0)) continue;
        if (!smallest || size < small) smallest = &scan, small = size;
        if (!largest || size > large) largest = &scan, large = size;
    }
    if (!smallest || large < kLeast * small || large > kMost * small) return;
    addNote(sink.cloud, largest->name,
            fmt::format("is {:.0f} times the size of {}: are the units metres and millimetres? To rescale a scan, bake "
                        "it by itself with --transform",
                        large / small, smallest->name));
}

} // namespace pointrt
