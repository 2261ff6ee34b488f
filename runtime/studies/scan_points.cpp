// SPDX-License-Identifier: Apache-2.0
#include "pointrt/pro.hpp"
#include "pointrt/studies.hpp"
#include "runtime/util/vec.h"

namespace pointrt {
namespace {

ProFile openScan(const std::string& path) {
    try {
        return ProFile(path, PRO_OPEN_SKIP_CHECKSUMS);
    } catch (const ProError& error) {
        throw TraceError(TraceError::Kind::kBadInput, error.what());
    }
}

bool isOriented(const ProFile& file) { return (file.info().flags & PRO_FLAG_ORIENTED) != 0; }

} // namespace

ScanPoints scanPoints(const std::string& path) {
    const ProFile file = openScan(path);
    const pro_info& info = file.info();
    const std::span<const std::uint8_t> noise = file.noise();
    ScanPoints points;
    points.oriented = isOriented(file);
    points.positions.reserve(3 * std::size_t{info.splat_count});
    points.normals.reserve(3 * std::size_t{info.splat_count});
    points.radii.reserve(info.splat_count);
    for (std::size_t i = 0; i < info.splat_count; ++i) {
        const pro_splat splat = file.splat(i);
        for (std::size_t axis = 0; axis < 3; ++axis)
            points.positions.push_back(info.origin[axis] + info.scale * splat.position[axis]);
        points.normals.insert(points.normals.end(), splat.normal, splat.normal + 3);
        const double radius = splat.radius * info.scale;
        points.radii.push_back(static_cast<float>(radius));
        if (!noise.empty()) points.noise.push_back(static_cast<float>(radius * noise[i] / PRO_NOISE_STEPS));
    }
    return points;
}

std::array<double, 3> scanUp(const std::string& path) {
    const ProFile file = openScan(path);
    const float* up = file.world().up;
    if (up[0] == 0 && up[1] == 0 && up[2] == 0) return {0, 0, 1};
    const Vec3 unit = normalize({up[0], up[1], up[2]});
    return {unit.x, unit.y, unit.z};
}

Sides sidesOf(const std::vector<std::string>& paths) {
    for (const std::string& path : paths)
        if (!isOriented(openScan(path))) return Sides::kBoth;
    return Sides::kFront;
}

} // namespace pointrt
