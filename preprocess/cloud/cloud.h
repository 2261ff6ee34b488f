// SPDX-License-Identifier: GPL-3.0-or-later
// The cloud as read: what the readers hand to the surface estimation.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace pointrt {

using Vec3f = Eigen::Vector3f;
using Vec3d = Eigen::Vector3d;
using Rgb8 = std::array<std::uint8_t, 3>;

/// Marks a point whose sensor position is not known.
constexpr std::uint32_t kNoSensor = std::numeric_limits<std::uint32_t>::max();

/// What a user should know of a file as it was read.
struct Note {
    std::string file, text;
    std::size_t more_files = 0; ///< of which the same is to be said
};

/// Points of one or several scans in one frame. Optional arrays are empty or as long as positions.
struct Cloud {
    /// Input coordinate = origin + position, per axis; whole numbers, so that no bit is lost in double.
    Vec3d origin = Vec3d::Zero();
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;                          ///< as given, any length; zero where missing
    std::vector<Rgb8> colors;                            ///< sRGB
    std::vector<std::uint32_t> sensor_of_point;          ///< index into sensors, or kNoSensor
    std::vector<Vec3f> sensors;                          ///< scanner positions, relative to origin
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< faces of a mesh, indices into positions

    std::size_t points_read = 0;       ///< in the files, non-finite ones included
    std::size_t points_non_finite = 0; ///< dropped while reading
    std::size_t points_unused = 0;     ///< dropped: vertices of meshes that no face uses
    std::vector<Note> notes;
};

} // namespace pointrt
