// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/study_options.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "format/base/error.h"
#include "format/cli/command_line.h"
#include "format/os/descriptor.h"
#include "format/os/terminal.h"
#include "runtime/util/parse.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

Sides parseSides(const std::string& text) {
    if (text == "front") return Sides::kFront;
    if (text == "both") return Sides::kBoth;
    throw std::invalid_argument("\"" + text + "\" is not auto, front or both");
}

bool isDigits(const std::string& text, std::size_t count) {
    return text.size() == count && text.find_first_not_of("0123456789") == text.npos;
}

} // namespace

void addValue(CommandLine& app, const std::string& name, const std::string& type, const std::string& help,
              const std::function<void(const std::string&)>& set, bool required, bool many) {
    const auto take = [name, set](const std::string& text) {
        try {
            set(text);
        } catch (const std::invalid_argument& error) {
            throw Error(ExitCode::kBadUsage, name + ": " + error.what());
        }
    };
    CLI::Option* option = nullptr;
    if (many)
        option = app.add_option_function<std::vector<std::string>>(
            name,
            [take](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) take(text);
            },
            help);
    else
        option = app.add_option_function<std::string>(name, take, help);
    option->type_name(type)->required(required);
    if (many) option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->allow_extra_args(false);
}

void addPointOutput(CommandLine& app, StudyOptions& options, bool required) {
    addOutput(app, options,
              "Points with their columns and the results, replacing an existing file: .ply, .pcd, .las, .laz, .e57 or "
              ".csv; - is PLY on standard output; .pro is a copy of the scan with the results as attributes",
              ".ply .pcd .las .laz .e57 .csv .pro", required);
}

void addStudyOptions(CommandLine& app, StudyOptions& options) {
    addScene(app, options);
    addPointOutput(app, options);
    app.add_option("--points", options.points,
                   "Evaluate these points instead of the scene's own: .pro, .proset, .toml, .las, .laz or .ply, or x y "
                   "z [nx ny nz] as .npy or text; - is standard input")
        ->type_name("FILE");
    completes(app, "--points", ".pro .proset .toml .las .laz .ply .npy .csv .txt");
    addValue(app, "--sides", "auto|front|both",
             "Sides of a point's disc that receive light or are visible (default auto: front if the scans' normals are "
             "oriented)",
             [&](const std::string& text) {
                 if (text == "auto")
                     options.sides.reset();
                 else
                     options.sides = parseSides(text);
             });
    addValue(app, "--up", "X,Y,Z", "Up in the scan's coordinates (default: the scan's up, else +Z)",
             [&](const std::string& text) { options.up = parseTriple(text); });
}

std::optional<int> parseStudyLine(CommandLine& app, int argc, const char* const* argv) {
    return parseCommandLine(app, argc, argv, {{".ply", "-o"}, {".las", "-o"}, {".laz", "-o"}, {".csv", "--points"}});
}

void checkStudyOptions(const StudyOptions& options) {
    if (options.points == "-" && isTerminal(kStandardInput))
        throw Error(ExitCode::kBadUsage, "--points -: standard input is a terminal");
    std::vector<std::string> inputs;
    if (!options.points.empty()) inputs.push_back(options.points);
    checkCommonOptions(options, inputs, "points");
}

std::array<double, 3> upOfScene(const std::optional<std::array<double, 3>>& given,
                                const std::vector<std::string>& scene) {
    if (!given) return scanUp(scene.front());
    const double size = length(vectorOf(*given));
    if (!(size > 0 && std::isfinite(size))) throw Error(ExitCode::kBadUsage, "--up: the vector has no direction");
    return arrayOf((1 / size) * vectorOf(*given));
}

GeoPlace parsePlace(const std::string& text) {
    const std::size_t comma = text.find(',');
    GeoPlace place;
    if (comma == text.npos || !parseNumber(text.substr(0, comma), place.latitude_deg) ||
        !parseNumber(text.substr(comma + 1), place.longitude_deg))
        throw std::invalid_argument("\"" + text + "\" is not LAT,LON, such as 47.37,8.54");
    if (!(place.latitude_deg >= -90 && place.latitude_deg <= 90))
        throw std::invalid_argument("the latitude must be from -90 to 90 degrees");
    if (!(place.longitude_deg >= -180 && place.longitude_deg <= 180))
        throw std::invalid_argument("the longitude must be from -180 to 180 degrees");
    return place;
}

CalendarDate parseDate(const std::string& text) {
    const bool is_date = text.size() == 10 && text[4] == '-' && text[7] == '-' && isDigits(text.substr(0, 4), 4) &&
                         isDigits(text.substr(5, 2), 2) && isDigits(text.substr(8), 2);
    if (!is_date) throw std::invalid_argument("\"" + text + "\" is not a date such as 2026-06-21");
    const CalendarDate date{std::stoi(text.substr(0, 4)), static_cast<unsigned>(std::stoi(text.substr(5, 2))),
                            static_cast<unsigned>(std::stoi(text.substr(8)))};
    const std::chrono::year_month_day day{std::chrono::year(date.year), std::chrono::month(date.month),
                                          std::chrono::day(date.day)};
    if (!day.ok()) throw std::invalid_argument(text + " does not exist");
    if (date.year < 1900 || date.year > 2100) throw std::invalid_argument(text + " is outside 1900 to 2100");
    return date;
}

double parseUtcOffset(const std::string& text) {
    if (text == "Z") return 0;
    const bool is_signed = text.starts_with('+') || text.starts_with('-');
    const std::size_t colon = text.find(':');
    const std::string hours = text.substr(is_signed ? 1 : 0, colon == text.npos ? colon : colon - (is_signed ? 1 : 0));
    const std::string minutes = colon == text.npos ? "00" : text.substr(colon + 1);
    const bool is_offset = (isDigits(hours, 1) || isDigits(hours, 2)) && isDigits(minutes, 2) && minutes < "60";
    if (!is_offset) throw std::invalid_argument("\"" + text + "\" is not an offset from UTC such as +02:00, -8 or Z");
    const double offset = std::stod(hours) + std::stod(minutes) / 60;
    if (offset > 14)
        throw std::invalid_argument(text + " is more than 14 hours from UTC"); // Kiribati has the largest offset in use
    return text.starts_with('-') ? -offset : offset;
}

std::array<double, 3> parseTriple(const std::string& text) { return arrayOf(parseVector(text)); }

} // namespace pointrt
