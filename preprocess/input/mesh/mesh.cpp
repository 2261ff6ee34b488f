// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/mesh.h"

#include <Eigen/Geometry>
#include <cmath>

#include "preprocess/ingest/scan_colors.h"

namespace pointrt {

namespace {

/// Adds the face's unit normal to its corners, weighted by the angle there.
void addFaceNormal(const Cloud& cloud, const std::array<std::uint32_t, 3>& face, std::vector<Vec3d>& sums) {
    std::array<Vec3d, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = cloud.positions[face[i]].cast<double>();
    for (int i = 0; i < 3; ++i) {
        const Vec3d next = corners[(i + 1) % 3] - corners[i], last = corners[(i + 2) % 3] - corners[i];
        const Vec3d cross = next.cross(last);
        const double sine = cross.stableNorm();
        if (sine > 0) sums[face[i]] += cross / sine * std::atan2(sine, next.dot(last));
    }
}

} // namespace

void addMeshNormals(Cloud& cloud) {
    if (cloud.triangles.empty()) return;
    std::vector<Vec3d> sums(cloud.positions.size(), Vec3d::Zero());
    for (const auto& face : cloud.triangles) addFaceNormal(cloud, face, sums);
    cloud.normals.resize(cloud.positions.size(), Vec3f::Zero());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double length = sums[i].stableNorm();
        // Below this, faces cancel and only rounding errors are left.
        if (cloud.normals[i].isZero(0) && length > 1e-9) cloud.normals[i] = (sums[i] / length).cast<float>();
    }
}

void paintVertices(const MeshPaint& paint, Cloud& cloud) {
    for (std::size_t face = 0; face < paint.faces.size(); ++face) {
        if (!paint.has(face)) continue;
        cloud.colors.resize(cloud.positions.size(), kGreyColor);
        for (int corner = 0; corner < 3; ++corner)
            cloud.colors[cloud.triangles[face][static_cast<std::size_t>(corner)]] = paint.at(face, Vec3d::Unit(corner));
    }
}

} // namespace pointrt
