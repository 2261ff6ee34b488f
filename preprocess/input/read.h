// SPDX-License-Identifier: GPL-3.0-or-later
// Reads scan files into one Cloud.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/ingest/columns.h"
#include "preprocess/ingest/point_filter.h"

namespace pointrt {

struct SinkOptions;

struct ReadOptions {
    /// Name of an InputFormat, which overrides detection; "" detects.
    std::string format;
    /// Above 0: number of points sampled over the area of meshes. 0: use their vertices. No value: samples the meshes
    /// whose vertices are too few for their faces, with as many points as they need.
    std::optional<std::uint64_t> sample_count = 0;
    std::uint64_t seed = 0; ///< of the sampling
    AttributeChoice attributes = {};
    FilterOptions filter = {};
    std::optional<Eigen::Affine3d> transform = {}; ///< of all files; applied after their poses
    /// Convert degrees of longitude and latitude to metres (scaleDegrees), unless there is a transform.
    bool scales_degrees = false;
    /// Convert the Gaussians of a radiance field to opaque discs; otherwise they are kept as they are.
    bool gaussians_as_discs = false;
    bool salvages = false;         ///< read the complete points of truncated files
    bool drops_withheld = false;   ///< leave out points that their file flags as withheld
    std::optional<int> level = {}; ///< finest level to read of files with levels of detail
    double skim = 1;               ///< share of each chunk of LAZ files to read, above 0: for previews
};

/// Progress of reading.
struct ReadStatus {
    double share = 0; ///< in [0, 1]
    std::size_t file = 0, files = 0;
    std::uint64_t points = 0; ///< read so far
};
using ReadProgress = std::function<void(const ReadStatus&)>;

/// Result of reading one file.
struct FileReport {
    std::string name, format;
    std::uint64_t points = 0, kept = 0, scans = 0;
    std::uint64_t meshes = 0;  ///< scans with faces
    std::uint64_t sampled = 0; ///< points sampled over its faces, replacing its vertices
    /// Number of points that the header declares, if the file is truncated and was salvaged; otherwise 0.
    std::uint64_t promised = 0;
    double seconds = 0;
    /// Names neither a coordinate system nor degrees, although files of its format may be in degrees.
    bool hides_frame = false;
};

/// Whether files of a format may have degrees for x and y without saying so.
bool mayHideDegrees(std::string_view format);

/// Whether every scan of the files has faces.
bool areMeshes(const std::vector<FileReport>& files);

/// The options that every reader needs.
SinkOptions sinkOptions(const ReadOptions& options);

/// Reads and merges paths ("-" is standard input) into one cloud.
/// Throws Error with "FILE[:PLACE]: reason" if a file cannot be read, is malformed or holds no finite point.
/// @param files receives a report for each file; may be null
Cloud readInputs(const std::vector<std::string>& paths, const ReadOptions& options, const ReadProgress& progress = {},
                 std::vector<FileReport>* files = nullptr);

} // namespace pointrt
