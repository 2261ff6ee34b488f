// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/lidar_options.h"

#include <algorithm>
#include <cmath>

#include "format/base/error.h"
#include "format/cli/command_line.h"

namespace pointrt {
namespace {

constexpr const char* kLidarName = "pointrt-rays lidar";
constexpr const char* kLidarAbout = "Simulates a laser scanner in a scene, from one place or along a trajectory.";
constexpr const char* kLidarExamples =
    "  pointrt-rays lidar street.pro --sensor car.toml --trajectory drive.csv -o scan.laz\n"
    "  pointrt-rays lidar site.pro --sensor tripod.toml --pose 500010,4500020,102 -o scan.ply --attributes "
    "classification\n";
constexpr const char* kLidarNotes =
    "A sensor file (TOML) describes the scan pattern, range, noise and detection of a scanner; docs/RAYS.md lists\n"
    "its keys, docs/sensors has examples. Columns of points: position, intensity, return_number,\n"
    "number_of_returns, gps_time, ring, range, power, incidence_deg, pulse, splat_id, instance_id.";

void addWhere(CommandLine& app, LidarOptions& options) {
    auto* trajectory = app.add_option("--trajectory", options.trajectory,
                                      "Poses of the scanner over time, overriding the sensor file: text with the "
                                      "columns t,x,y,z and qx,qy,qz,qw or yaw,pitch,roll")
                           ->type_name("FILE");
    completes(app, "--trajectory", ".csv .txt");
    app.add_option("--pose", options.pose, "Pose of a fixed scanner: X,Y,Z or X,Y,Z,YAW,PITCH,ROLL; angles in degrees")
        ->type_name("POSE")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->excludes(trajectory);
    app.add_option("--start", options.start_s, "Start at this time of the trajectory, in seconds (default: its start)")
        ->type_name("S");
    app.add_option(
           "--duration", options.duration_s,
           "Scan for S seconds (default: the whole trajectory; with a fixed scanner, one rotation, frame or sweep)")
        ->type_name("S");
}

void addOptions(CommandLine& app, LidarOptions& options) {
    addScene(app, options);
    addOutput(app, options, "Points, replacing an existing file: .ply, .pcd, .las, .laz, .e57 or .csv",
              ".ply .pcd .las .laz .e57 .csv");
    app.add_option("--sensor", options.sensor, "Sensor file that describes the scanner")->required()->type_name("FILE");
    completes(app, "--sensor", ".toml");
    addWhere(app, options);
    app.add_option("--seed", options.seed, "Random seed (default 0)")->type_name("N");
    app.add_option("--metres-per-unit", options.metres_per_unit,
                   "Metres per unit of the scan's coordinates (default: the scan's own, else 1)")
        ->type_name("M");
    app.add_option("--attributes", options.attributes,
                   "Attributes of the scan to copy to the points, e.g. classification")
        ->type_name("NAMES")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kLidarExamples, kLidarNotes);
}

void checkOptions(const LidarOptions& options) {
    const auto usage = [](const std::string& text) { throw Error(ExitCode::kBadUsage, text); };
    const bool finite =
        std::all_of(options.pose.begin(), options.pose.end(), [](double n) { return std::isfinite(n); });
    if (!finite || (!options.pose.empty() && options.pose.size() != 3 && options.pose.size() != 6))
        usage("--pose: must be three or six finite numbers, X,Y,Z or X,Y,Z,YAW,PITCH,ROLL");
    if (options.metres_per_unit < 0 || std::isnan(options.metres_per_unit)) usage("--metres-per-unit: must be above 0");
    if (options.output == "-")
        usage("-o -: points cannot be streamed, as their number is not known in advance; write a file");
    std::vector<std::string> inputs{options.sensor};
    if (!options.trajectory.empty()) inputs.push_back(options.trajectory);
    checkCommonOptions(options, inputs, "points");
}

} // namespace

std::optional<int> parseLidarOptions(int argc, const char* const* argv, LidarOptions& options) {
    CommandLine app(kLidarAbout, kLidarName);
    addOptions(app, options);
    if (const auto done = parseCommandLine(
            app, argc, argv,
            {{".toml", "--sensor"}, {".csv", "--trajectory"}, {".las", "-o"}, {".laz", "-o"}, {".ply", "-o"}}))
        return done;
    checkOptions(options);
    return {};
}

CommandText lidarText() {
    LidarOptions options;
    CommandLine app(kLidarAbout, kLidarName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt
