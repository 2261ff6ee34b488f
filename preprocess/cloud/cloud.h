// SPDX-License-Identifier: GPL-3.0-or-later
// The cloud as read: what the readers hand to the surface estimation.
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

/// Marks a point whose sensor position is not known.
constexpr std::uint32_t kNoSensor = std::numeric_limits<std::uint32_t>::max();

/// What a user should know of a file as it was read.
struct Note {
    std::string file, text;
    std::size_t more_files = 0; ///< of which the same is to be said
};

/// One station of a scanner, or one file where a file is one scan.
struct Scan {
    std::string name;            ///< for people: the file, and what it calls the scan
    std::optional<Vec3d> sensor; ///< where the scanner stood, input coordinates
    std::size_t first_point = 0; ///< its points are those from here on to the next scan's
};

/// The samples of one scan as its device took them: what lies beside what, and where nothing came back.
struct RangeGrid {
    static constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();
    static constexpr std::uint32_t kLeftOut = kNoPoint - 1; ///< a sample that was taken, but not asked for

    std::uint32_t scan = 0; ///< its number in Cloud::scans
    std::uint32_t rows = 0, columns = 0;
    bool wraps = false;                       ///< the last column lies beside the first
    std::vector<std::uint32_t> point_of_cell; ///< [rows][columns], index into positions, kNoPoint or kLeftOut

    std::uint32_t at(std::uint32_t row, std::uint32_t column) const {
        return point_of_cell[std::size_t{row} * columns + column];
    }
};

/// How the input's coordinates lie in the world, as far as files say; what they disagree on is not known.
struct WorldFrame {
    Vec3d up = Vec3d::Zero();   ///< unit length; zero: not known
    bool up_by_custom = false;  ///< up is what files of the format mostly have, which this one does not say
    double metres_per_unit = 0; ///< 0: not known
    bool from_above = false;    ///< airborne: every surface was seen from above
    std::string crs;            ///< coordinate system: WKT, or "EPSG:N"; "": not known
};

/// Points of one or several scans in one frame. Optional arrays are empty or as long as positions.
struct Cloud {
    /// Input coordinate = origin + position, per axis; whole numbers, so that no bit is lost in double.
    Vec3d origin = Vec3d::Zero();
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals;                 ///< as given, any length; zero where missing
    bool normal_sides = true;                   ///< normals point out; false: some are axes
    std::vector<Rgb8> colors;                   ///< sRGB
    std::vector<std::uint32_t> sensor_of_point; ///< index into sensors, or kNoSensor
    std::vector<Vec3f> sensors;                 ///< scanner positions, relative to origin
    std::vector<float> radii;                   ///< as given; 0 where missing
    std::vector<float> noise; ///< standard deviation along the sight, as the device's own; 0 where not known
    std::vector<Attribute> attributes;
    std::vector<Scan> scans;      ///< in the order read; attribute kScanNumber numbers them where there are several
    std::vector<RangeGrid> grids; ///< of scans that came as such
    WorldFrame world;
    std::string source_header; ///< JSON of what a writer of the input's format needs to write it again, or ""
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< faces of a mesh, indices into positions

    std::size_t points_read = 0;       ///< in the files, non-finite ones included
    std::size_t points_non_finite = 0; ///< dropped while reading
    std::size_t points_unused = 0;     ///< dropped: vertices of meshes that no face uses
    std::size_t points_filtered = 0;   ///< dropped: not asked for
    std::vector<Note> notes;
};

} // namespace pointrt
