// SPDX-License-Identifier: GPL-3.0-or-later
// Where the readers put their vertices and faces: one file at a time into the cloud of all files.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/input/batches.h"
#include "preprocess/input/columns.h"
#include "preprocess/input/grid.h"
#include "preprocess/input/point_filter.h"
#include "preprocess/input/roles.h"
#include "preprocess/input/source.h"

namespace pointrt {

/// Placement of a scan in the world: world = linear * scan + translation. A rotation, but where a file scales too.
struct Pose {
    Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
    Vec3d translation = Vec3d::Zero();
};

/// How colour values become 8-bit ones. Bytes are taken as they are; integers are 16-bit ones when any exceeds 255;
/// reals are shares of 1 unless any exceeds 1, and then integers. 16-bit ones come with a column kRgb16 beside the row:
/// what they are scaled by is told by its largest value, and the attribute keeps all of their bits.
enum class ColorScale { kByte, kInteger, kReal, k16Bit };

/// What a reader knows before its first vertex.
struct ScanTraits {
    bool normals = false;
    bool normal_sides = true; ///< false: normals are axes, and which way is out is for others to tell
    bool colors = false;
    bool radii = false;
    bool faces = true; ///< false: no polygon will be added, and vertices that are dropped need not be known
    ColorScale color_scale = ColorScale::kByte;
    std::vector<ColumnTraits> columns; ///< attributes, in the order of the values given to addVertex
    /// As many vertices as the file is known to hold, 0 if unknown: reserved, and measures the progress.
    std::uint64_t vertices = 0;
};

/// One range of the cloud that came from one scan.
struct ScanRange {
    std::string name; ///< of the file
    std::size_t first_position = 0, position_count = 0;
    bool has_faces = false;
};

struct Sink {
    explicit Sink(Cloud& all_files) : cloud(all_files) {}

    Cloud& cloud;
    std::vector<ScanRange> scans; ///< finished ones
    std::optional<Pose> world_from_scan;
    std::optional<Eigen::Affine3d> world_from_input; ///< of all files, after their poses
    AttributeChoice attributes;
    PointFilter filter{{}};
    std::optional<int> level;             ///< of files with levels of detail: nothing finer is read
    std::function<void(double)> progress; ///< share of the current file, or empty
    /// Vertices, by their place in the cloud, whose faces went with a vertex that was dropped.
    std::vector<std::uint32_t> bereft;

    /// The first positions of all in the world, until the cloud's origin is settled by them.
    std::vector<Vec3d> first_positions;
    bool origin_settled = false;

    bool scales_degrees = false;      ///< degrees will be scaled to metres, where all files are in degrees
    std::size_t files_in_degrees = 0; ///< x and y are degrees

    Columns columns;
    bool first_frame = true;    ///< no file has said yet how it lies in the world
    Batches* batches = nullptr; ///< where points are handed on while they are read; null: the cloud keeps them

    // Of the scan that is being read:
    ScanTraits traits;
    Eigen::Affine3d world_from_vertex = Eigen::Affine3d::Identity();
    Eigen::Matrix3d normal_from_vertex = Eigen::Matrix3d::Identity();
    std::optional<std::size_t> rgb16_offset, class_offset; ///< in a vertex's packed values
    std::optional<std::size_t> rgb16_column, class_column; ///< numbers of the traits' columns
    Scalar class_type = Scalar::kU8;
    std::optional<std::size_t> rgb16_attribute;      ///< of the cloud, which keeps 16-bit colours as they are
    std::vector<std::array<std::uint16_t, 3>> rgb16; ///< of kept vertices, where no attribute keeps them
    std::uint64_t vertices = 0;                      ///< given so far, non-finite ones included
    std::uint64_t non_finite = 0;                    ///< of them
    std::vector<std::uint32_t> dropped;            ///< which of them did not stay, ascending, where there may be faces
    std::vector<std::array<float, 3>> wide_colors; ///< of kept vertices, where the scale is known at the end only
    std::size_t first_position = 0, first_triangle = 0;
    std::uint64_t kept_before = 0; ///< points of all scans before
    std::optional<Vec3d> sensor;   ///< scanner position in the scan's frame
    GridBuilder grid;
};

/// Points of all scans so far, whether the cloud still has them or not.
std::uint64_t keptPoints(const Sink& sink);

/// Starts a scan: a file, or one of several in it. Throws Error when the cloud would have more points than its 32-bit
/// indices can tell apart, or classes are chosen and the file has none.
void beginScan(Sink& sink, const Source& source, const ScanTraits& traits);

/// Adds one vertex, given in the scan's frame. A position that is not finite, in double or once rounded to float, or
/// 1e25 and more from zero is dropped and counted; so is, apart, one that the filter does not want.
/// @param values of the traits' columns, packed in their types; null where there are none
/// @return its index in the cloud, of use where that keeps its points, or the mark of a range grid: kNoPoint where it
/// is dropped, kLeftOut where the filter does not want it
std::uint32_t addVertex(Sink& sink, const Row& row, const char* values = nullptr);

/// Adds many vertices that have no normals, radii or faces, and colours of 16 bits or none: the same as adding them one
/// by one, but several times as fast.
/// @param columns of each of the traits' columns the values, one vertex after the other
void addVertices(Sink& sink, std::span<const Vec3d> positions, std::span<const char* const> columns);

/// Counts a vertex that the reader leaves out, as one that is not wanted.
void skipVertex(Sink& sink);

/// Adds a polygon of 3 or more file indices, each below the number of vertices of the file, as a fan of triangles.
void addPolygon(Sink& sink, std::span<const std::uint32_t> corners);

/// Whether a scan may be without points: one of several in a file may, as long as another one has some.
enum class Emptiness { kRefused, kAllowed };

/// The box around the points of the last finished scan, input coordinates.
struct ScanBox {
    Vec3d center, size;
};
ScanBox boxOfScan(const Sink& sink);

/// Ends a scan: scales its colours, drops faces with dropped vertices, fills what other files have and it has not.
/// Throws Error when no finite point was given and that is refused.
/// @param title what a file calls one of several scans in it; "" where the file is the scan
void finishScan(Sink& sink, const Source& source, const std::string& title = "",
                Emptiness emptiness = Emptiness::kRefused);

/// Keeps what a file says of its coordinates, as far as the files before it agree; call it once a file.
void setWorldFrame(Sink& sink, const Source& source, const WorldFrame& frame);

/// Has text said of a file; once, however many files and times it is said of.
void addNote(Cloud& cloud, const std::string& file, const std::string& text);

/// Makes world_position the sensor of the last finished scan; ignored when it is not finite.
void setSensor(Sink& sink, const Vec3d& world_position);

/// As setSensor, of a scanner that sweeps a sheet of light in parallel over the object and looks along -Z of the scan's
/// frame, as those of the Stanford 3D Scanning Repository.
void setSensorAlongZ(Sink& sink);

} // namespace pointrt
