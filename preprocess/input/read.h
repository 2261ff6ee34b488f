// SPDX-License-Identifier: GPL-3.0-or-later
// Scan files to one Cloud.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

struct ReadOptions {
    /// Name of an InputFormat, to overrule detection; "" detects.
    std::string format;
    /// Above 0, meshes are sampled with this many points spread over their area instead of by their vertices.
    std::uint64_t sample_count = 0;
    std::uint64_t seed = 0; ///< of the sampling
};

/// Called with the share done in [0, 1] while reading.
using ReadProgress = std::function<void(double)>;

/// Reads and merges paths ("-" is standard input) into one cloud.
/// Throws Error with "FILE[:PLACE]: reason" when a file cannot be read, is malformed or holds no finite point.
Cloud readInputs(const std::vector<std::string>& paths, const ReadOptions& options, const ReadProgress& progress = {});

} // namespace pointrt
