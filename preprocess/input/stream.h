// SPDX-License-Identifier: GPL-3.0-or-later
// Scan files read in batches of points, in as many passes as needed: memory is bounded whatever their size.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "preprocess/ingest/batches.h"
#include "preprocess/ingest/no_data.h"
#include "preprocess/input/read.h"

namespace pointrt {

/// A place between two files, where a reading may resume.
struct StreamPlace {
    std::size_t file = 0, scan = 0; ///< indices of the next ones
    std::uint64_t kept = 0;         ///< points kept before
    std::uint64_t seen = 0;         ///< points that the filter has seen before
};

/// Points without data of a scan, see Sink::no_data.
struct StreamNoData {
    std::size_t scan = 0; ///< its number
    NoData points;
};

/// Findings of the first pass over all files.
struct StreamFindings {
    /// The cloud without its points: scans, frame, notes, counts, and attributes with their names and the types that
    /// readers need.
    Cloud cloud;
    std::vector<std::string> untyped, minor; ///< names of attributes, as in Columns
    std::vector<std::uint64_t> scan_points;
    std::vector<float> largest_color; ///< BatchFindings::largest_color
    bool colors = false;
    std::vector<StreamNoData> no_data; ///< points that were handed on unless StreamOptions::no_data has them
    std::vector<FileReport> files;
};

struct StreamOptions {
    ReadOptions read;
    std::size_t batch_points = std::size_t{1} << 20;
    /// Size limit in bytes of files that must be read at once (meshes, grids, Gaussians).
    std::uint64_t largest_whole_file = std::uint64_t{512} << 20;
    std::uint64_t most_in_grid = std::uint64_t{1} << 24; ///< BatchOptions::most_in_grid
    const StreamFindings* first_pass = nullptr;          ///< null in the first pass
    std::vector<StreamNoData> no_data;                   ///< points to leave out, as an earlier pass found them
    StreamPlace start;                                   ///< where to resume an interrupted reading
    std::function<void(const StreamPlace&)> file_done = {};
};

/// Reads the files and hands on their points in batches, those of a scan in the order of the file. In the first pass,
/// batches have no colours except bytes, and attribute types may change from file to file. Given the findings of the
/// first pass, each batch has attributes of the types found, in their order, and no others. Throws Error as readInputs
/// does, and if a file is in degrees or too large to be read at once.
StreamFindings readInBatches(const std::vector<std::string>& paths, const StreamOptions& options,
                             const std::function<void(const PointBatch&)>& take, const ReadProgress& progress = {});

} // namespace pointrt
