// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/sun_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "format/base/error.h"
#include "format/cli/command_line.h"
#include "runtime/rays/study_run.h"
#include "runtime/rays/usage.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

constexpr const char* kName = "pointrt-rays sun";
constexpr const char* kAbout = "Hours of direct sun on the points of a scan, and how much of the sky they see.";
constexpr const char* kExamples =
    "  pointrt-rays sun roof.pro --at 47.37,8.54 --date 2026-06-21 -o june.laz\n"
    "  pointrt-rays sun roof.pro --at 47.37,8.54 --date 2026-01-01 --to 2026-12-31 --every 60 --sky -o year.ply\n"
    "  pointrt-rays sun street.pro --points windows.csv --at -33.87,151.21 --date 2026-06-21 -o windows_sun.csv\n";
constexpr const char* kNotes =
    "Columns: sun_hours (hours that the sun shines on a point, of all days together), and with --sky sky_view (0 to "
    "1,\n"
    "the share of an evenly bright sky's light that reaches level ground there). The sun's place is within 0.02\n"
    "degrees, with refraction; docs/RAYS.md has the rules.";
constexpr std::size_t kSkyDirections = 256; // a step of sky_view is a point of 0.4%

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
        app, "--at", "LAT,LON", "Where the scan is, in degrees: north and east are above 0",
        [&](const std::string& text) { options.study.place = parsePlace(text); }, true);
    addValue(
        app, "--date", "DATE", "The day, or the first one: 2026-06-21",
        [&](const std::string& text) { options.study.first = parseDate(text); }, true);
    addValue(app, "--to", "DATE", "The last day (that of --date)",
             [&](const std::string& text) { options.last = parseDate(text); });
    addValue(app, "--every", "MINUTES", "Between instants, of which each stands for the time around it (15)",
             [&](const std::string& text) { options.study.every_min = parseRealAbove(text, 0, 1440); });
    addValue(app, "--zone", "OFFSET", "Where days begin at midnight: +02:00, -8, Z (15 degrees of longitude an hour)",
             [&](const std::string& text) { options.study.utc_offset_h = parseUtcOffset(text); });
    addValue(app, "--north", "X,Y,Z",
             "True north in the scan's coordinates (by its coordinate system, else +Y, or -Z where Y is up)",
             [&](const std::string& text) { options.north = parseTriple(text); });
    app.add_flag("--sky", options.sky, "The share of the sky that points see, too");
    addValue(app, "--sky-rays", "N", "Directions that the sky is divided into (256)", [&](const std::string& text) {
        options.sky_rays = parseCount(text, 1, 65536);
        options.sky_rays_given = true;
    });
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kExamples, kNotes);
}

void checkOptions(SunOptions& options) {
    checkStudyOptions(options);
    options.study.last = options.last.value_or(options.study.first);
    if (options.sky_rays_given && !options.sky) throw Error(ExitCode::kBadUsage, "--sky-rays goes with --sky");
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

void sayWhat(const SunOptions& options, const Lights& sun, const StudyFrame& frame) {
    const SunStudy& study = options.study;
    const double above = std::accumulate(sun.weights.begin(), sun.weights.end(), 0.0);
    sayLine(options, "sun: " + std::to_string(sun.weights.size()) + " instants, " + hoursText(above) +
                         " hours above the horizon; days begin at midnight, " +
                         zoneText(study.utc_offset_h.value_or(utcOffsetOf(study.place))) +
                         (study.utc_offset_h ? "" : " (by the longitude)") + "; " + frame.note);
}

/// Sums of the lights that reach the points, as floats. Lights go in groups that take about a second.
std::uint64_t sumAll(const OpenStudy& study, const StudyPoints& points, std::size_t count, const Lights& lights,
                     std::vector<std::byte>& values, const TellShare& tell) {
    constexpr std::size_t kRaysBetweenTells = std::size_t{1} << 22;
    const std::size_t at_once = std::max<std::size_t>(1, kRaysBetweenTells / std::max<std::size_t>(1, count));
    std::vector<double> sums(count);
    std::uint64_t rays = 0;
    for (std::size_t first = 0; first < lights.weights.size(); first += at_once) {
        const auto end = static_cast<std::ptrdiff_t>(std::min(first + at_once, lights.weights.size()));
        const auto begin = static_cast<std::ptrdiff_t>(first);
        const Lights some{{lights.directions.begin() + 3 * begin, lights.directions.begin() + 3 * end},
                          {lights.weights.begin() + begin, lights.weights.begin() + end}};
        rays += sumLights(study.scene, points, some, study.rules, sums);
        tell(static_cast<double>(end) / static_cast<double>(lights.weights.size()));
    }
    values.resize(count * sizeof(float));
    std::ranges::transform(sums, numbersIn<float>(values).begin(), [](double sum) { return static_cast<float>(sum); });
    return rays;
}

void runSun(const SunOptions& options) {
    withToolErrors([&] { sunLights(options.study, {}); }); // what is wrong with it, before anything takes time
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
        sayWhat(options, sun, frame);
    };
    work.block = [&](const OpenStudy& study, const StudyPoints& points, std::size_t count,
                     std::vector<std::vector<std::byte>>& values, const TellShare& tell) {
        const double lights = static_cast<double>(sun.weights.size() + sky.weights.size());
        const double of_sun = lights > 0 ? static_cast<double>(sun.weights.size()) / lights : 1;
        std::uint64_t rays = sumAll(study, points, count, sun, values[0], [&](double share) { tell(share * of_sun); });
        if (options.sky)
            rays += sumAll(study, points, count, sky, values[1],
                           [&](double share) { tell(of_sun + share * (1 - of_sun)); });
        return rays;
    };
    runStudy(options, work);
}

} // namespace

int sunCommand(int argc, const char* const* argv) {
    SunOptions options;
    CommandLine app(kAbout, kName);
    addOptions(app, options);
    if (const auto done = parseStudyLine(app, argc, argv)) return *done;
    checkOptions(options);
    runSun(options);
    return 0;
}

CommandText sunText() {
    SunOptions options;
    CommandLine app(kAbout, kName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt
