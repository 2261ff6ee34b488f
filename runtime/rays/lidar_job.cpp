// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/lidar_job.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "format/base/report_file.h"
#include "format/pointio/point_sink.h"
#include "format/set/tile_set.h"
#include "pointrt/lidar.hpp"
#include "pointrt/pro.hpp"
#include "runtime/rays/lidar_columns.h"
#include "runtime/rays/lidar_options.h"
#include "runtime/rays/open_scene.h"
#include "runtime/rays/run_report.h"
#include "runtime/util/render_progress.h"

namespace pointrt {
namespace {

struct LidarSeconds {
    double open = 0, simulate = 0, write = 0, total = 0;
};

struct LidarOutcome {
    std::string device;
    std::uint64_t splats = 0, pulses = 0, rays = 0, points = 0;
    LidarSeconds seconds;
};

LidarPose poseOf(const std::vector<double>& numbers) {
    LidarPose pose;
    std::copy_n(numbers.begin(), 3, pose.position.begin());
    if (numbers.size() == 6) pose.rotation = lidarRotation(numbers[3], numbers[4], numbers[5]);
    return pose;
}

/// The pose or trajectory of the command line overrides the sensor file's.
LidarRun runOf(const LidarOptions& options, const LidarSensorFile& file) {
    LidarRun run;
    run.trajectory = file.trajectory;
    if (!options.trajectory.empty()) run.trajectory = readLidarTrajectory(options.trajectory);
    if (!options.pose.empty()) run.trajectory = {poseOf(options.pose)};
    if (run.trajectory.empty())
        throw Error(ExitCode::kBadUsage, options.sensor + ": has no pose or trajectory; give --pose or --trajectory");
    run.start_s = options.start_s;
    run.duration_s = options.duration_s;
    run.seed = options.seed;
    run.metres_per_unit = options.metres_per_unit;
    return run;
}

/// Finer than the range resolution of any scanner.
constexpr double kPositionStep_m = 1e-4;

/// Points inherit the coordinate system and records of the first scan.
std::string metadataOf(const std::string& path) {
    if (isTileSet(path)) return nlohmann::json{{"world", {{"crs", readTileSet(path).crs}}}}.dump();
    if (path.ends_with(".toml")) return {};                                // instances in scene files may be moved
    return std::string(ProFile(path, PRO_OPEN_SKIP_CHECKSUMS).metadata()); // checked when the scene was opened
}

/// Uses the trajectory in place of the points' bounds, from which LAS derives its offset.
PointOutline outlineOf(const LidarOptions& options, const TraceScene& scene, const LidarColumns& columns,
                       const LidarRun& run) {
    PointOutline outline;
    outline.columns = columns.columns();
    outline.metres_per_unit = options.metres_per_unit > 0 ? options.metres_per_unit : scene.metresPerUnit();
    outline.position_step = kPositionStep_m / (outline.metres_per_unit > 0 ? outline.metres_per_unit : 1);
    outline.keeps_source_scale = false;
    outline.metadata = metadataOf(options.scene.front());
    outline.program = "pointrt-rays " POINTRT_VERSION;
    outline.bounds_min = outline.bounds_max = run.trajectory.front().position;
    for (const LidarPose& pose : run.trajectory)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            outline.bounds_min[axis] = std::min(outline.bounds_min[axis], pose.position[axis]);
            outline.bounds_max[axis] = std::max(outline.bounds_max[axis], pose.position[axis]);
        }
    return outline;
}

void simulateToFile(const LidarOptions& options, const TraceScene& scene, const LidarSensor& sensor,
                    const LidarRun& run, LidarOutcome& outcome) {
    const PointFormat format = pointFormat(options.output);
    const LidarColumns columns(scene, sensor, format == PointFormat::kLas || format == PointFormat::kLaz,
                               options.attributes);
    const std::unique_ptr<PointSink> sink = openPointSink(options.output, outlineOf(options, scene, columns, run));
    RenderProgress progress(options.quiet, options.verbose, false);
    PointBlock block;
    double both = 0;
    timed(both, [&] {
        simulateLidar(scene, sensor, run, [&](const LidarPoints& points) {
            timed(outcome.seconds.write, [&] {
                columns.fill(points, block);
                sink->add(block);
            });
            outcome.pulses = points.pulses_done;
            outcome.points += points.size();
            progress.update(static_cast<double>(points.pulses_done) / static_cast<double>(points.pulses_total));
        });
    });
    outcome.seconds.simulate = both - outcome.seconds.write;
    outcome.rays = outcome.pulses * sensor.rays;
    progress.finish();
    timed(outcome.seconds.write, [&] { sink->finish(); });
}

/// Checks inputs and outputs before starting the work that takes time.
LidarOutcome simulate(const LidarOptions& options) {
    LidarOutcome outcome;
    timed(outcome.seconds.total, [&] {
        pointFormat(options.output);
        if (!options.stats.empty()) requireReportWritable(options.stats);
        const LidarSensorFile file = readLidarSensor(options.sensor);
        const LidarRun run = runOf(options, file);
        lidarPulseCount(file.sensor, run);
        const TraceScene scene = timed(outcome.seconds.open, [&] { return openScene(options, outcome.device); });
        outcome.splats = scene.splatCount();
        simulateToFile(options, scene, file.sensor, run, outcome);
    });
    return outcome;
}

std::string reportOf(const LidarOutcome& outcome) {
    const LidarSeconds& s = outcome.seconds;
    return reportText(
        outcome.device,
        {{"splats", outcome.splats}, {"pulses", outcome.pulses}, {"rays", outcome.rays}, {"points", outcome.points}},
        {{"open", s.open}, {"cast", s.simulate}, {"write", s.write}, {"total", s.total}});
}

} // namespace

int lidarCommand(int argc, const char* const* argv) {
    LidarOptions options;
    if (const auto done = parseLidarOptions(argc, argv, options)) return *done;
    const LidarOutcome outcome = withToolErrors([&] { return simulate(options); });
    if (options.verbose)
        std::fprintf(stderr, "%llu pulses, %llu points; %.2f million rays a second on %s\n",
                     static_cast<unsigned long long>(outcome.pulses), static_cast<unsigned long long>(outcome.points),
                     1e-6 * static_cast<double>(outcome.rays) / std::max(outcome.seconds.simulate, 1e-9),
                     outcome.device.c_str());
    if (!options.stats.empty()) writeReport(options.stats, reportOf(outcome));
    return 0;
}

} // namespace pointrt
