// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/sun_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "format/base/error.h"
#include "format/cli/command_line.h"
#include "runtime/rays/run_report.h"
#include "runtime/rays/study_run.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr const char* kSunName = "pointrt-rays sun";
constexpr const char* kSunAbout = "Computes hours of direct sun on points, and how much of the sky they see.";
constexpr const char* kSunExamples =
    "  pointrt-rays sun roof.pro --at 47.37,8.54 --date 2026-06-21 -o june.laz\n"
    "  pointrt-rays sun roof.pro --at 47.37,8.54 --date 2026-01-01 --to 2026-12-31 --every 60 --sky -o year.ply\n"
    "  pointrt-rays sun street.pro --points windows.csv --at -33.87,151.21 --date 2026-06-21 -o windows_sun.csv\n";
constexpr const char* kSunNotes =
    "Columns: sun_hours (hours of direct sun, summed over all days) and, with --sky, sky_view (0 to 1: the share of\n"
    "a uniform sky's irradiance on level ground that reaches the point). The position of the sun is accurate to 0.02\n"
    "degrees and includes refraction. True north in a projected coordinate system needs PROJ (Debian, Ubuntu:\n"
    "libproj25). See docs/RAYS.md.";
constexpr std::size_t kSkyDirections = 256; // sky_view has steps of 0.4%

struct SunOptions : StudyOptions {
    SunStudy study;
    std::optional<CalendarDate> last;
    std::optional<std::array<double, 3>> north;
    bool sky = false;
    std::size_t sky_rays = kSkyDirections;
    bool sky_rays_given = false;
};

void addOptions(CommandLine& app, SunOptions& options) {
    addStudyOptions(app, options);
    addValue(
        app, "--at", "LAT,LON", "Location of the scan in degrees, north and east positive",
        [&](const std::string& text) { options.study.place = parsePlace(text); }, true);
    addValue(
        app, "--date", "DATE", "First day, e.g. 2026-06-21",
        [&](const std::string& text) { options.study.first = parseDate(text); }, true);
    addValue(app, "--to", "DATE", "Last day (default: the first)",
             [&](const std::string& text) { options.last = parseDate(text); });
    addValue(app, "--every", "MINUTES", "Minutes between two positions of the sun (default 15)",
             [&](const std::string& text) { options.study.every_min = parseRealAbove(text, 0, 1440); });
    addValue(
        app, "--zone", "OFFSET",
        "UTC offset of the local time in which days begin at midnight: +02:00, -8, Z (default: from the longitude, 15 "
        "degrees per hour)",
        [&](const std::string& text) { options.study.utc_offset_h = parseUtcOffset(text); });
    addValue(app, "--north", "X,Y,Z",
             "True north in the scan's coordinates (default: from its coordinate system, else +Y, or -Z if Y is up)",
             [&](const std::string& text) { options.north = parseTriple(text); });
    app.add_flag("--sky", options.sky, "Also compute the sky view factor of the points");
    addValue(app, "--sky-rays", "N", "Number of rays that sample the sky (default 256)", [&](const std::string& text) {
        options.sky_rays = parseCount(text, 1, 65536);
        options.sky_rays_given = true;
    });
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kSunExamples, kSunNotes);
}

void checkOptions(SunOptions& options) {
    checkStudyOptions(options);
    options.study.last = options.last.value_or(options.study.first);
    if (options.sky_rays_given && !options.sky) throw Error(ExitCode::kBadUsage, "--sky-rays needs --sky");
}

std::string hoursText(double hours) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", hours);
    return text;
}

/// "UTC-08:00"
std::string zoneText(double offset_h) {
    const auto minutes = static_cast<int>(std::lround(60 * std::abs(offset_h)));
    char text[32];
    std::snprintf(text, sizeof text, "UTC%c%02d:%02d", offset_h < 0 ? '-' : '+', minutes / 60, minutes % 60);
    return text;
}

void printSummary(const SunOptions& options, const Lights& sun, const StudyFrame& frame) {
    const SunStudy& study = options.study;
    const double above = std::accumulate(sun.weights.begin(), sun.weights.end(), 0.0);
    printNote(options, "sun: " + std::to_string(sun.weights.size()) + " instants, " + hoursText(above) +
                           " hours above the horizon; days begin at midnight, " +
                           zoneText(study.utc_offset_h.value_or(utcOffsetOf(study.place))) +
                           (study.utc_offset_h ? "" : " (from the longitude)") + "; " + frame.note);
}

/// Sums the weights of the lights that reach each point, as floats, in groups of lights that take about a second.
std::uint64_t sumAll(const OpenStudy& study, const StudyPoints& points, std::size_t count, const Lights& lights,
                     std::vector<std::byte>& values, const ReportProgress& report) {
    constexpr std::size_t kRaysBetweenUpdates = std::size_t{1} << 22;
    const std::size_t at_once = std::max<std::size_t>(1, kRaysBetweenUpdates / std::max<std::size_t>(1, count));
    std::vector<double> sums(count);
    std::uint64_t rays = 0;
    for (std::size_t first = 0; first < lights.weights.size(); first += at_once) {
        const auto end = static_cast<std::ptrdiff_t>(std::min(first + at_once, lights.weights.size()));
        const auto begin = static_cast<std::ptrdiff_t>(first);
        const Lights some{{lights.directions.begin() + 3 * begin, lights.directions.begin() + 3 * end},
                          {lights.weights.begin() + begin, lights.weights.begin() + end}};
        rays += sumLights(study.scene, points, some, study.rules, sums);
        report(static_cast<double>(end) / static_cast<double>(lights.weights.size()));
    }
    values.resize(count * sizeof(float));
    std::ranges::transform(sums, numbersIn<float>(values).begin(), [](double sum) { return static_cast<float>(sum); });
    return rays;
}

void runSun(const SunOptions& options) {
    withToolErrors([&] { sunLights(options.study, {}); }); // throws early if options are invalid
    Lights sun, sky;
    StudyWork work;
    work.results = {{"sun_hours", PRO_TYPE_F32}};
    if (options.sky) work.results.push_back({"sky_view", PRO_TYPE_F32});
    work.begin = [&](OpenStudy& study) {
        const StudyFrame frame = studyFrame(options.scene.front(), options.study.place, options.up, options.north);
        study.rules.up = frame.up;
        sun = sunLights(options.study, frame);
        if (options.sky) sky = skyLights(options.sky_rays, frame);
        work.counts = {{"instants", sun.weights.size()}};
        printSummary(options, sun, frame);
    };
    work.block = [&](const OpenStudy& study, const StudyPoints& points, std::size_t count,
                     std::vector<std::vector<std::byte>>& values, const ReportProgress& report) {
        const double lights = static_cast<double>(sun.weights.size() + sky.weights.size());
        const double of_sun = lights > 0 ? static_cast<double>(sun.weights.size()) / lights : 1;
        std::uint64_t rays =
            sumAll(study, points, count, sun, values[0], [&](double share) { report(share * of_sun); });
        if (options.sky)
            rays += sumAll(study, points, count, sky, values[1],
                           [&](double share) { report(of_sun + share * (1 - of_sun)); });
        return rays;
    };
    runStudy(options, work);
}

} // namespace

int sunCommand(int argc, const char* const* argv) {
    SunOptions options;
    CommandLine app(kSunAbout, kSunName);
    addOptions(app, options);
    if (const auto done = parseStudyLine(app, argc, argv)) return *done;
    checkOptions(options);
    runSun(options);
    return 0;
}

CommandText sunText() {
    SunOptions options;
    CommandLine app(kSunAbout, kSunName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt
