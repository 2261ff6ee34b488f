// SPDX-License-Identifier: GPL-3.0-or-later
// Scan files to one Cloud.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"
#include "preprocess/input/columns.h"
#include "preprocess/input/point_filter.h"

namespace pointrt {

struct ReadOptions {
    /// Name of an InputFormat, to overrule detection; "" detects.
    std::string format;
    /// Above 0, meshes are sampled with this many points spread over their area; 0 takes their vertices. Without a
    /// value those are sampled, with as many points as they need, whose vertices are too few for their faces.
    std::optional<std::uint64_t> sample_count = 0;
    std::uint64_t seed = 0; ///< of the sampling
    AttributeChoice attributes = {};
    FilterOptions filter = {};
    std::optional<Eigen::Affine3d> transform = {}; ///< of all files, after their poses
    /// Makes degrees of longitude and latitude metres (scaleDegrees), unless there is a transform.
    bool scales_degrees = false;
    std::optional<int> level = {}; ///< of files with levels of detail: nothing finer is read
};

/// How far reading is.
struct ReadStatus {
    double share = 0; ///< done, in [0, 1]
    std::size_t file = 0, files = 0;
    std::uint64_t points = 0; ///< read so far
};
using ReadProgress = std::function<void(const ReadStatus&)>;

/// What came of one file.
struct FileReport {
    std::string name, format;
    std::uint64_t points = 0, kept = 0, scans = 0;
    std::uint64_t sampled = 0; ///< points spread over its faces, instead of its vertices
    double seconds = 0;
};

/// Reads and merges paths ("-" is standard input) into one cloud.
/// Throws Error with "FILE[:PLACE]: reason" when a file cannot be read, is malformed or holds no finite point.
/// @param files receives a report for each file, may be null
Cloud readInputs(const std::vector<std::string>& paths, const ReadOptions& options, const ReadProgress& progress = {},
                 std::vector<FileReport>* files = nullptr);

} // namespace pointrt
