// SPDX-License-Identifier: GPL-3.0-or-later
// The point cloud as read: output of the readers, input of the surface estimation.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/cloud/attribute.h"

namespace pointrt {

using Vec3f = Eigen::Vector3f;
using Vec3d = Eigen::Vector3d;
using Rgb8 = std::array<std::uint8_t, 3>;

/// Marks points without a known sensor position.
constexpr std::uint32_t kNoSensor = std::numeric_limits<std::uint32_t>::max();

/// A message for the user about reading a file.
struct Note {
    std::string file, text;
    std::size_t more_files = 0; ///< with the same message
};

/// One scanner station, or one file if the format has no stations.
struct Scan {
    std::string name;            ///< for display: the file, and its name for the scan
    std::optional<Vec3d> sensor; ///< scanner position, input coordinates
    std::size_t first_point = 0; ///< its points end where those of the next scan begin
};

/// The samples of one scan in the device's row and column order, including those without a return.
struct RangeGrid {
    static constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();
    static constexpr std::uint32_t kFilteredOut = kNoPoint - 1; ///< a sample that the filters drop

    std::uint32_t scan = 0; ///< index in Cloud::scans
    std::uint32_t rows = 0, columns = 0;
    bool wraps = false;                       ///< the last column is next to the first
    std::vector<std::uint32_t> point_of_cell; ///< [rows][columns], index into positions, kNoPoint or kFilteredOut

    std::uint32_t at(std::uint32_t row, std::uint32_t column) const {
        return point_of_cell[std::size_t{row} * columns + column];
    }
};

/// The world frame of the input coordinates, as far as files state it; values on which files disagree are unknown.
struct WorldFrame {
    Vec3d up = Vec3d::Zero();   ///< unit length; zero: unknown
    bool up_by_custom = false;  ///< up is the convention of the format, not stated by the file
    double metres_per_unit = 0; ///< 0: unknown
    bool from_above = false;    ///< airborne: all surfaces were scanned from above
    std::string crs;            ///< coordinate system: WKT, or "EPSG:N"; "": unknown
};

/// Points of one or several scans in one frame. Optional arrays are empty or of the length of positions.
struct Cloud {
    /// Input coordinate = origin + position, per axis; origin is whole numbers, so that the sum is exact in double.
    Vec3d origin = Vec3d::Zero();
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;                 ///< as in the file, of any length; zero if missing
    bool normal_sides = true;                   ///< normals point outwards; false: some have an arbitrary sign
    std::vector<Rgb8> colors;                   ///< sRGB
    std::vector<std::uint32_t> sensor_of_point; ///< index into sensors, or kNoSensor
    std::vector<Vec3f> sensors;                 ///< scanner positions, relative to origin
    std::vector<float> radii;                   ///< as in the file; 0 if missing
    std::vector<float> noise; ///< standard deviation along the line of sight, by device model; 0 if unknown
    std::vector<Attribute> attributes;
    std::vector<Scan> scans;      ///< in reading order, as in the attribute kScanNumber
    std::vector<RangeGrid> grids; ///< of scans stored as grids
    WorldFrame world;
    std::string source_header; ///< JSON with the input's header for exports, or "" (META in SPEC.md)
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< faces of a mesh, indices into positions

    std::size_t points_read = 0;       ///< including non-finite ones
    std::size_t points_non_finite = 0; ///< dropped while reading
    std::size_t points_unused = 0;     ///< dropped: mesh vertices that no face uses
    std::size_t points_filtered = 0;   ///< dropped by filters
    std::size_t points_no_data = 0;    ///< dropped: a coordinate marks missing data
    std::size_t points_withheld = 0;   ///< dropped: flagged as withheld
    std::vector<Note> notes;
};

} // namespace pointrt
