// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/study_run.h"

#include <algorithm>
#include <cstdio>

#include "format/base/report_file.h"
#include "format/pointio/point_sink.h"
#include "runtime/rays/open_scene.h"
#include "runtime/rays/pro_results.h"
#include "runtime/rays/run_report.h"
#include "runtime/rays/scene_points.h"
#include "runtime/util/render_progress.h"

namespace pointrt {
namespace {

struct StudySeconds {
    double open = 0, read = 0, cast = 0, write = 0, total = 0;
};

struct StudyOutcome {
    std::string device;
    std::uint64_t splats = 0, points = 0, rays = 0;
    StudySeconds seconds;
};

OpenStudy openStudy(const StudyOptions& options, std::string& device_name) {
    OpenStudy study{openScene(options, device_name), {}};
    study.rules.sides = options.sides ? *options.sides : sidesOf(options.scene);
    study.rules.up = options.up ? *options.up : scanUp(options.scene.front());
    if (!options.points.empty()) study.rules.radius = medianRadius(options.scene);
    return study;
}

PointOutline withResults(const PointOutline& points, const std::vector<PointColumn>& results) {
    PointOutline outline = points;
    outline.columns.insert(outline.columns.end(), results.begin(), results.end());
    outline.program = "pointrt-rays " POINTRT_VERSION;
    return outline;
}

std::unique_ptr<PointSource> openStudyPoints(const StudyOptions& options, const std::vector<std::string>& results) {
    if (!isProOutput(options.output)) return openPoints(options.points, options.scene, results);
    return sceneSplats(options.points.empty() ? options.scene : std::vector{options.points}, results);
}

/// Null without an output. scan: as requireOutput returned it
std::unique_ptr<PointSink> openResults(const StudyOptions& options, const std::string& scan, const PointOutline& points,
                                       const std::vector<PointColumn>& results) {
    if (options.output.empty()) return nullptr;
    if (!scan.empty()) return openProSink(options.output, scan, results);
    return openPointSink(options.output, withResults(points, results));
}

/// Throws early if an output cannot be written. Returns the scan to copy with the results; "": they are written as
/// points.
std::string requireOutput(const StudyOptions& options) {
    if (isProOutput(options.output)) return scanOfResults(options.points, options.scene);
    if (!options.output.empty()) pointFormat(options.output);
    return {};
}

void runBlocks(const StudyOptions& options, const OpenStudy& study, StudyWork& work, PointSource& source,
               PointSink* sink, StudyOutcome& outcome) {
    RenderProgress progress(options.quiet, options.verbose, false);
    const auto all = static_cast<double>(std::max<std::uint64_t>(1, source.outline().count.value_or(1)));
    StudyBlock block;
    std::vector<std::vector<std::byte>> values(work.results.size());
    while (timed(outcome.seconds.read, [&] { return source.next(block); })) {
        const std::size_t count = block.points.count();
        const auto report_progress = [&](double share) {
            progress.update((static_cast<double>(outcome.points) + share * static_cast<double>(count)) / all);
        };
        outcome.rays += timed(outcome.seconds.cast,
                              [&] { return work.block(study, block.rows(), count, values, report_progress); });
        for (std::vector<std::byte>& each : values) block.points.columns.push_back(std::move(each));
        if (sink) timed(outcome.seconds.write, [&] { sink->add(block.points); });
        outcome.points += count;
    }
    progress.finish();
}

void report(const StudyOptions& options, const StudyWork& work, const StudyOutcome& outcome) {
    const StudySeconds& s = outcome.seconds;
    std::vector<std::pair<std::string, std::uint64_t>> counts{
        {"splats", outcome.splats}, {"points", outcome.points}, {"rays", outcome.rays}};
    counts.insert(counts.end(), work.counts.begin(), work.counts.end());
    if (options.verbose)
        std::fprintf(stderr, "%llu points, %llu rays; %.2f million rays a second on %s\n",
                     static_cast<unsigned long long>(outcome.points), static_cast<unsigned long long>(outcome.rays),
                     s.cast > 0 ? 1e-6 * static_cast<double>(outcome.rays) / s.cast : 0, outcome.device.c_str());
    if (!options.stats.empty())
        writeReport(
            options.stats,
            reportText(outcome.device, counts,
                       {{"open", s.open}, {"read", s.read}, {"cast", s.cast}, {"write", s.write}, {"total", s.total}}));
}

void runInto(const StudyOptions& options, StudyWork& work, StudyOutcome& outcome) {
    const std::string scan = requireOutput(options);
    if (!options.stats.empty()) requireReportWritable(options.stats);
    OpenStudy study = timed(outcome.seconds.open, [&] { return openStudy(options, outcome.device); });
    outcome.splats = study.scene.splatCount();
    work.begin(study);
    std::vector<std::string> names;
    for (const PointColumn& column : work.results) names.push_back(column.name);
    const std::unique_ptr<PointSource> source =
        timed(outcome.seconds.read, [&] { return openStudyPoints(options, names); });
    const std::unique_ptr<PointSink> sink = openResults(options, scan, source->outline(), work.results);
    runBlocks(options, study, work, *source, sink.get(), outcome);
    if (sink) timed(outcome.seconds.write, [&] { sink->finish(); });
}

} // namespace

void runStudy(const StudyOptions& options, StudyWork& work) {
    StudyOutcome outcome;
    withToolErrors([&] { timed(outcome.seconds.total, [&] { runInto(options, work, outcome); }); });
    report(options, work, outcome);
}

} // namespace pointrt
