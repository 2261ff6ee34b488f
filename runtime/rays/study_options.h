// SPDX-License-Identifier: Apache-2.0
// Options of sun and viewshed, and words of them as values.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "pointrt/studies.hpp"
#include "runtime/rays/common_options.h"

namespace pointrt {

struct StudyOptions : CommonOptions {
    std::string points;         ///< a file; "": the scene's own
    std::optional<Sides> sides; ///< none: by the scans
    std::optional<std::array<double, 3>> up;
};

/// SCENE, -o, --points, --sides, --up.
void addStudyOptions(CommandLine& app, StudyOptions& options);
/// An option with a value that set takes; what set throws as std::invalid_argument becomes "NAME: reason".
/// @param many it may be given several times
void addValue(CommandLine& app, const std::string& name, const std::string& type, const std::string& help,
              const std::function<void(const std::string&)>& set, bool required = false, bool many = false);
/// As parseCommandLine, which knows what files of studies are for.
std::optional<int> parseStudyLine(CommandLine& app, int argc, const char* const* argv);
/// As checkCommonOptions.
void checkStudyOptions(const StudyOptions& options);

/// Each takes all of text and throws std::invalid_argument with the reason.
GeoPlace parsePlace(const std::string& text);    ///< "LAT,LON"
CalendarDate parseDate(const std::string& text); ///< "2026-06-21"
double parseUtcOffset(const std::string& text);  ///< "+2", "-03:30", "Z", in hours
std::array<double, 3> parseTriple(const std::string& text);

} // namespace pointrt
