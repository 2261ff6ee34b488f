// SPDX-License-Identifier: Apache-2.0
// Runs a study: reads points block by block and writes them with the results as further columns.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "format/pointio/point_columns.h"
#include "pointrt/studies.hpp"
#include "runtime/rays/point_source.h"
#include "runtime/rays/study_options.h"

namespace pointrt {

/// An open scene, and the rules for its points.
struct OpenStudy {
    TraceScene scene;
    StudyRules rules;
};

/// Called with the share of the block's work that is done, in [0, 1].
using ReportProgress = std::function<void(double)>;

/// The parts of a study that differ between commands.
struct StudyWork {
    std::vector<PointColumn> results; ///< columns that the study adds, in order
    /// Called once before the first block and before any progress is shown. May change the rules.
    std::function<void(OpenStudy&)> begin;
    /// Overwrites values, one array per result, with a row for each point of a block. Returns the number of rays cast.
    std::function<std::uint64_t(const OpenStudy&, const StudyPoints&, std::size_t count,
                                std::vector<std::vector<std::byte>>& values, const ReportProgress&)>
        block;
    /// Further numbers of the report, such as "instants".
    std::vector<std::pair<std::string, std::uint64_t>> counts;
};

/// Without options.output, only calls work. Memory does not grow with the number of points, except by 4 bytes per point
/// of the largest file or tile. Throws Error with a one-line message, and then leaves no new output file.
void runStudy(const StudyOptions& options, StudyWork& work);

} // namespace pointrt
