// SPDX-License-Identifier: Apache-2.0
// Options shared by sun and viewshed, and parsers of their values.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "pointrt/studies.hpp"
#include "runtime/rays/common_options.h"

namespace pointrt {

struct StudyOptions : CommonOptions {
    std::string points;         ///< a file; "": the points of the scene
    std::optional<Sides> sides; ///< none: chosen by sidesOf()
    std::optional<std::array<double, 3>> up;
};

/// Adds -o for points with results.
void addPointOutput(CommandLine& app, StudyOptions& options, bool required = true);
/// Adds SCENE, -o, --points, --sides, --up.
void addStudyOptions(CommandLine& app, StudyOptions& options);
/// Adds an option whose value is parsed by `set`; a std::invalid_argument from `set` becomes the error "NAME: reason".
/// @param many the option can be given several times
void addValue(CommandLine& app, const std::string& name, const std::string& type, const std::string& help,
              const std::function<void(const std::string&)>& set, bool required = false, bool many = false);
/// parseCommandLine with the suffixes of output files of studies.
std::optional<int> parseStudyLine(CommandLine& app, int argc, const char* const* argv);
/// checkCommonOptions for studies.
void checkStudyOptions(const StudyOptions& options);

/// The given up direction as a unit vector; else that of the scene, else +Z. Throws Error kBadUsage for a zero vector,
/// TraceError as scanUp does.
std::array<double, 3> upOfScene(const std::optional<std::array<double, 3>>& given,
                                const std::vector<std::string>& scene);

/// Each parses all of text and throws std::invalid_argument with the reason.
GeoPlace parsePlace(const std::string& text);    ///< "LAT,LON"
CalendarDate parseDate(const std::string& text); ///< "2026-06-21"
double parseUtcOffset(const std::string& text);  ///< hours: "+2", "-03:30", "Z"
std::array<double, 3> parseTriple(const std::string& text);

} // namespace pointrt
