// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh.h"

#include <Eigen/Geometry>

namespace pointrt {

void addMeshNormals(Cloud& cloud) {
    if (cloud.triangles.empty()) return;
    std::vector<Vec3d> sums(cloud.positions.size(), Vec3d::Zero());
    for (const auto& [a, b, c] : cloud.triangles) {
        const Vec3d corner = cloud.positions[a].cast<double>();
        // The length of the cross product is twice the area: the weight comes by itself.
        const Vec3d normal =
            (cloud.positions[b].cast<double>() - corner).cross(cloud.positions[c].cast<double>() - corner);
        for (const std::uint32_t vertex : {a, b, c}) sums[vertex] += normal;
    }
    cloud.normals.resize(cloud.positions.size(), Vec3f::Zero());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double length = sums[i].stableNorm();
        if (cloud.normals[i].isZero(0) && length > 0) cloud.normals[i] = (sums[i] / length).cast<float>();
    }
}

} // namespace pointrt
