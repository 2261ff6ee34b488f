// SPDX-License-Identifier: GPL-3.0-or-later
// Scan files read in batches of points, as often as is needed: memory is bounded whatever they hold.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "preprocess/input/batches.h"
#include "preprocess/input/read.h"

namespace pointrt {

/// Between two files.
struct StreamPlace {
    std::size_t file = 0, scan = 0; ///< the next ones
    std::uint64_t kept = 0;         ///< points before
    std::uint64_t seen = 0;         ///< points that the filter was asked about
};

/// What a first reading tells of all files.
struct StreamFindings {
    /// The cloud without its points: scans, frame, notes, counts, attributes by name and the type that readers need.
    Cloud cloud;
    std::vector<std::string> loose, minor; ///< names of attributes, as Columns has them
    std::vector<std::uint64_t> scan_points;
    std::vector<float> largest_color; ///< Batches::largest_color
    bool colors = false;
    std::vector<FileReport> files;
};

struct StreamOptions {
    ReadOptions read;
    std::size_t batch_points = std::size_t{1} << 20;
    /// Files of formats that are read as a whole (meshes, grids, Gaussians) may have so many bytes.
    std::uint64_t largest_whole_file = std::uint64_t{512} << 20;
    const StreamFindings* known = nullptr; ///< of the first reading; null: this is it
    StreamPlace start;                     ///< of a reading that goes on
    std::function<void(const StreamPlace&)> file_done = {};
};

/// Reads the files and hands their points on, those of a scan in the order of the file. Without `known` colours that
/// are not bytes are left out of the batches, and attributes may change their types from file to file. With it, each
/// batch has attributes of the types found, in their order, and no others.
/// Throws Error as readInputs does, and for a file that is in degrees or too large to be read whole.
StreamFindings readInBatches(const std::vector<std::string>& paths, const StreamOptions& options,
                             const std::function<void(const PointBatch&)>& take, const ReadProgress& progress = {});

} // namespace pointrt
