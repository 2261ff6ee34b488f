// SPDX-License-Identifier: Apache-2.0
// Truth and splats in one frame, where the truth's bounding sphere has radius 1 around the origin.
#pragma once

#include <string>

#include "preprocess/cloud/cloud.h"

namespace pointrt::quality {

struct UnitFrame {
    Vec3d center = Vec3d::Zero(); ///< input units
    double radius = 1;            ///< input units

    Vec3f unitFromInput(const Vec3d& position) const { return ((position - center) / radius).cast<float>(); }
};

/// The true surface.
struct Mesh {
    UnitFrame frame;
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals; ///< [vertices], from the file, or the mean of their faces'
    std::vector<std::array<std::uint32_t, 3>> triangles;

    Vec3d corner(std::uint32_t triangle, int i) const { return positions[triangles[triangle][i]].cast<double>(); }
    /// Outward, of twice the triangle's area as length.
    Vec3d faceNormal(std::uint32_t triangle) const {
        return (corner(triangle, 1) - corner(triangle, 0)).cross(corner(triangle, 2) - corner(triangle, 0));
    }
};

/// The splats of a .pro.
struct Discs {
    std::vector<Vec3f> centers;
    std::vector<Vec3f> normals; ///< unit length
    std::vector<float> radii;
    float median_radius = 0; ///< the unit of errors; the same everywhere, as samples are spread evenly
    bool oriented = false;
};

/// Reads a mesh as pointrt-bake does. Flips faces and normals if they point inwards overall.
/// Throws Error (kBadInput) if it has no faces.
Mesh loadMesh(const std::string& path);

/// @param frame of the mesh to compare with
Discs loadDiscs(const std::string& path, const UnitFrame& frame);

} // namespace pointrt::quality
