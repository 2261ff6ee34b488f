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
#include "preprocess/input/source/roles.h"
#include "preprocess/input/source/source.h"

namespace pointrt {

/// Rigid placement of a scan in the world: world = rotation * scan + translation.
struct Pose {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Vec3d translation = Vec3d::Zero();
};

/// How colour values become 8-bit ones. Bytes are taken as they are; integers are 16-bit ones when any exceeds 255;
/// reals are shares of 1 unless any exceeds 1, and then integers.
enum class ColorScale { kByte, kInteger, kReal };

/// What a reader knows before its first vertex.
struct ScanTraits {
    bool normals = false;
    bool colors = false;
    ColorScale color_scale = ColorScale::kByte;
    /// As many vertices as the file is known to hold, 0 if unknown: reserved, and measures the progress.
    std::uint64_t vertices = 0;
};

/// One range of the cloud that came from one file.
struct ScanRange {
    std::string name;
    std::size_t first_position = 0, position_count = 0;
    bool has_faces = false;
};

struct Sink {
    explicit Sink(Cloud& all_files) : cloud(all_files) {}

    Cloud& cloud;
    std::vector<ScanRange> scans; ///< finished ones
    std::optional<Pose> world_from_scan;
    std::function<void(double)> progress; ///< share of the current file, or empty
    /// Vertices, by their place in the cloud, whose faces went with a vertex that was dropped.
    std::vector<std::uint32_t> bereft;

    /// The first positions of all in the world, until the cloud's origin is settled by them.
    std::vector<Vec3d> first_positions;
    bool origin_settled = false;

    // Of the file that is being read:
    ScanTraits traits;
    std::uint64_t vertices = 0;                    ///< given so far, non-finite ones included
    std::vector<std::uint32_t> dropped;            ///< which of them were not finite, ascending
    std::vector<std::array<float, 3>> wide_colors; ///< of kept vertices, where the scale is known at the end only
    std::size_t first_position = 0, first_triangle = 0;
    std::optional<Vec3d> sensor; ///< scanner position in the scan's frame
};

/// Starts a file. Throws Error when the cloud would have more points than its 32-bit indices can tell apart.
void beginScan(Sink& sink, const Source& source, const ScanTraits& traits);

/// Adds one vertex, given in the scan's frame. A position that is not finite, in double or once rounded to float, or
/// 1e25 and more from zero is dropped and counted.
void addVertex(Sink& sink, const Row& row);

/// Adds a polygon of 3 or more file indices, each below the number of vertices of the file, as a fan of triangles.
void addPolygon(Sink& sink, std::span<const std::uint32_t> corners);

/// Ends a file: scales its colours, drops faces with dropped vertices, fills what other files have and it has not.
/// Throws Error when no finite point was given.
void finishScan(Sink& sink, const Source& source);

/// Has text said of a file; once, however many files and times it is said of.
void addNote(Cloud& cloud, const std::string& file, const std::string& text);

/// Makes world_position the sensor of one finished scan; ignored when it is not finite.
void setSensor(Cloud& cloud, const ScanRange& scan, const Vec3d& world_position);

/// A position of the scan's frame in the world.
Vec3d toWorld(const Sink& sink, const Vec3d& position);

} // namespace pointrt
