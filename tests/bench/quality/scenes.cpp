// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality/scenes.h"

#include "format/base/error.h"
#include "pointrt/pro.hpp"
#include "preprocess/input/read.h"
#include "tests/bench/quality/statistics.h"

namespace pointrt::quality {

namespace {

UnitFrame frameOf(const Cloud& cloud) {
    Eigen::AlignedBox3d box;
    for (const Vec3f& position : cloud.positions) box.extend(position.cast<double>());
    return {cloud.origin + box.center(), box.diagonal().norm() / 2};
}

/// Six times the enclosed volume, negative if faces point inwards; approximate if the mesh has holes.
double signedVolume(const Mesh& mesh) {
    double sum = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) sum += mesh.corner(i, 0).dot(mesh.faceNormal(i));
    return sum;
}

void turn(Mesh& mesh) {
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    for (Vec3f& normal : mesh.normals) normal = -normal;
}

} // namespace

Mesh loadMesh(const std::string& path) {
    Cloud cloud = readInputs({path}, {});
    if (cloud.triangles.empty()) throw Error(ExitCode::kBadInput, path + ": has no faces");
    Mesh mesh{frameOf(cloud), {}, std::move(cloud.normals), std::move(cloud.triangles)};
    for (const Vec3f& position : cloud.positions)
        mesh.positions.push_back(mesh.frame.unitFromInput(cloud.origin + position.cast<double>()));
    if (signedVolume(mesh) < 0) turn(mesh);
    return mesh;
}

Discs loadDiscs(const std::string& path, const UnitFrame& frame) {
    const ProFile file(path);
    const pro_info& info = file.info();
    const Vec3d origin(info.origin[0], info.origin[1], info.origin[2]);
    Discs discs;
    discs.oriented = (info.flags & PRO_FLAG_ORIENTED) != 0;
    for (std::size_t i = 0; i < info.splat_count; ++i) {
        const pro_splat splat = file.splat(i);
        const Vec3d cube(splat.position[0], splat.position[1], splat.position[2]);
        discs.centers.push_back(frame.unitFromInput(origin + info.scale * cube));
        discs.normals.push_back(Vec3f(splat.normal[0], splat.normal[1], splat.normal[2]).normalized());
        discs.radii.push_back(static_cast<float>(splat.radius * info.scale / frame.radius));
    }
    discs.median_radius = static_cast<float>(summarize(discs.radii).median);
    return discs;
}

} // namespace pointrt::quality
