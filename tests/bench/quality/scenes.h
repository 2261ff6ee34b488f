// SPDX-License-Identifier: Apache-2.0
// Truth and what was made of it, in one frame: the truth's bounding sphere has radius 1 about the origin.
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
    std::vector<Vec3f> normals; ///< of vertices: the file's own, or the mean of their faces'
    std::vector<std::array<std::uint32_t, 3>> triangles;

    Vec3d corner(std::uint32_t triangle, int i) const { return positions[triangles[triangle][i]].cast<double>(); }
    /// Outwards, of twice the triangle's area; zero where that is.
    Vec3d faceNormal(std::uint32_t triangle) const {
        return (corner(triangle, 1) - corner(triangle, 0)).cross(corner(triangle, 2) - corner(triangle, 0));
    }
};

/// The splats of a .pro.
struct Discs {
    std::vector<Vec3f> centers;
    std::vector<Vec3f> normals; ///< unit length
    std::vector<float> radii;
    float median_radius = 0; ///< the unit of errors: samples are spread evenly, so that it is the same everywhere
    bool oriented = false;
};

/// Reads a mesh as pointrt-bake does. Faces and normals that point inwards on the whole are turned.
/// Throws Error (kBadInput) when it has no faces.
Mesh loadMesh(const std::string& path);

/// @param frame of the mesh to compare with
Discs loadDiscs(const std::string& path, const UnitFrame& frame);

} // namespace pointrt::quality
