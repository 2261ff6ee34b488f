// SPDX-License-Identifier: Apache-2.0
// A study from its scene to its output: blocks of points in, results beside their columns out.
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

/// Share of the block's work that is done, in [0, 1].
using TellShare = std::function<void(double)>;

/// What a study does.
struct StudyWork {
    std::vector<PointColumn> results; ///< of each point, in order
    /// Called once before the first block. May change the rules. What is said there comes before all progress.
    std::function<void(OpenStudy&)> begin;
    /// The results' values for a block's points, a row each, in place of what values hold. Returns the rays cast.
    std::function<std::uint64_t(const OpenStudy&, const StudyPoints&, std::size_t count,
                                std::vector<std::vector<std::byte>>& values, const TellShare&)>
        block;
    /// For the report: "instants" and such.
    std::vector<std::pair<std::string, std::uint64_t>> counts;
};

/// Memory does not grow with the number of the scene's points, but for 4 bytes of each of the largest file or tile.
/// Throws Error with one line;
/// then no output is there that was not.
void runStudy(const StudyOptions& options, StudyWork& work);

/// Says a line on standard error, unless quiet.
void sayLine(const StudyOptions& options, const std::string& line);

} // namespace pointrt
