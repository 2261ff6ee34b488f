// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/cast_job.h"

#include <cstdio>
#include <future>
#include <utility>

#include "format/base/error.h"
#include "format/base/report_file.h"
#include "runtime/rays/cast_options.h"
#include "runtime/rays/hit_sink.h"
#include "runtime/rays/open_scene.h"
#include "runtime/rays/ray_source.h"
#include "runtime/rays/run_report.h"
#include "runtime/util/render_progress.h"

namespace pointrt {
namespace {

/// Seconds that this thread spent on each part, or waited for it. Rays are read in parallel with the other parts.
struct CastSeconds {
    double open = 0, read = 0, cast = 0, write = 0, total = 0;
};

struct CastOutcome {
    std::uint64_t rays = 0, hits = 0;
    CastSeconds seconds;
};

/// Fills columns with the block's hits. Errors name the ray by its place in the input.
std::size_t castBlock(const TraceScene& scene, const RaySource& source, const RayBlock& block, const RayLimits& limits,
                      std::span<HitColumn> columns) {
    try {
        return fillColumns(scene, block.rows(), limits, columns);
    } catch (const RayError& error) {
        throw Error(exitCodeOf(error), source.placeOf(block, error.ray) + ": " + error.reason);
    }
}

/// Reads the next block while one is cast.
CastOutcome castAll(const TraceScene& scene, RaySource& source, HitSink& sink, std::vector<HitColumn>& columns,
                    const CastOptions& options) {
    CastOutcome outcome;
    RenderProgress progress(options.quiet, options.verbose, false);
    RayBlock block, next;
    bool more = timed(outcome.seconds.read, [&] { return source.next(block); });
    while (more) {
        std::future<bool> reading = std::async(std::launch::async, [&] { return source.next(next); });
        outcome.hits +=
            timed(outcome.seconds.cast, [&] { return castBlock(scene, source, block, options.limits, columns); });
        timed(outcome.seconds.write, [&] { sink.add(columns, block.first); });
        outcome.rays = block.first + block.rows().count;
        if (const auto count = source.count())
            progress.update(static_cast<double>(outcome.rays) / static_cast<double>(*count));
        more = timed(outcome.seconds.read, [&] { return reading.get(); });
        std::swap(block, next);
    }
    progress.finish();
    return outcome;
}

double raysPerSecond(const CastOutcome& outcome) {
    return outcome.seconds.cast > 0 ? static_cast<double>(outcome.rays) / outcome.seconds.cast : 0;
}

/// Numbers of the scene for the report.
struct SceneFacts {
    std::string device;
    std::uint64_t splats = 0, tile_loads = 0;
};

std::string reportOf(const CastOutcome& outcome, const SceneFacts& facts) {
    const CastSeconds& s = outcome.seconds;
    return reportText(
        facts.device,
        {{"splats", facts.splats}, {"tile_loads", facts.tile_loads}, {"rays", outcome.rays}, {"hits", outcome.hits}},
        {{"open", s.open}, {"read", s.read}, {"cast", s.cast}, {"write", s.write}, {"total", s.total}});
}

void castToFile(const CastOptions& options) {
    double total = 0, open = 0;
    CastOutcome outcome;
    SceneFacts facts;
    timed(total, [&] {
        const std::unique_ptr<RaySource> source = openRays(options.rays);
        const SinkRequest request{options.output, source->count(), options.any};
        sinkKind(request); // fails early on an unknown suffix
        if (!options.stats.empty()) requireReportWritable(options.stats);
        const TraceScene scene = timed(open, [&] { return openScene(options, facts.device); });
        facts.splats = scene.splatCount();
        std::vector<HitColumn> columns = options.any ? occlusionColumns() : hitColumns(scene, options.attributes);
        const std::unique_ptr<HitSink> sink = openSink(request, columns);
        outcome = castAll(scene, *source, *sink, columns, options);
        timed(outcome.seconds.write, [&] { sink->finish(); });
        facts.tile_loads = scene.tileLoads();
    });
    outcome.seconds.open = open;
    outcome.seconds.total = total;
    if (options.verbose)
        std::fprintf(stderr, "%llu rays, %llu hits; %.2f million rays a second on %s\n",
                     static_cast<unsigned long long>(outcome.rays), static_cast<unsigned long long>(outcome.hits),
                     1e-6 * raysPerSecond(outcome), facts.device.c_str());
    if (!options.stats.empty()) writeReport(options.stats, reportOf(outcome, facts));
}

} // namespace

int castCommand(int argc, const char* const* argv) {
    CastOptions options;
    if (const auto done = parseCastOptions(argc, argv, options)) return *done;
    withToolErrors([&] { castToFile(options); });
    return 0;
}

} // namespace pointrt
