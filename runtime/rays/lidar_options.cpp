// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/lidar_options.h"

#include <algorithm>
#include <cmath>

#include "format/base/error.h"
#include "format/cli/command_line.h"

namespace pointrt {
namespace {

constexpr const char* kName = "pointrt-rays lidar";
constexpr const char* kAbout =
    "Simulates a laser scanner: what it would measure of scans, from one place or along a trajectory.";
constexpr const char* kExamples =
    "  pointrt-rays lidar street.pro --sensor car.toml --trajectory drive.csv -o scan.laz\n"
    "  pointrt-rays lidar site.pro --sensor tripod.toml --pose 500010,4500020,102 -o scan.ply --attributes "
    "classification\n";
constexpr const char* kNotes =
    "A sensor file (TOML) says how the scanner's beams go, what it can measure and how well; docs/RAYS.md has all "
    "keys\n"
    "and docs/sensors has examples. Points: positions, intensity, return_number, number_of_returns, gps_time, ring,\n"
    "range, power, incidence_deg, pulse, splat_id, instance_id.";

void addWhere(CommandLine& app, LidarOptions& options) {
    auto* trajectory = app.add_option("--trajectory", options.trajectory,
                                      "Where the scanner is at which time: text under t,x,y,z and qx,qy,qz,qw or "
                                      "yaw,pitch,roll; in place of the sensor file's")
                           ->type_name("FILE");
    completes(app, "--trajectory", ".csv .txt");
    app.add_option("--pose", options.pose, "Where it stands: X,Y,Z or X,Y,Z,YAW,PITCH,ROLL, in degrees")
        ->type_name("POSE")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->excludes(trajectory);
    app.add_option("--start", options.start_s, "Begin at this time of the trajectory")->type_name("S");
    app.add_option("--duration", options.duration_s,
                   "Scan for so long (the whole trajectory; one turn, frame or swing from one place)")
        ->type_name("S");
}

void addOptions(CommandLine& app, LidarOptions& options) {
    addSceneAndOutput(app, options, "Points, by the suffix: .ply, .las, .laz, .csv; what is there is replaced",
                      ".ply .las .laz .csv");
    app.add_option("--sensor", options.sensor, "The scanner: a sensor file")->required()->type_name("FILE");
    completes(app, "--sensor", ".toml");
    addWhere(app, options);
    app.add_option("--seed", options.seed, "Of all that is random (0)")->type_name("N");
    app.add_option("--metres-per-unit", options.metres_per_unit,
                   "How long a unit of the scan is (as the scan says, else 1)")
        ->type_name("M");
    app.add_option("--attributes", options.attributes, "Attributes of the scan at the points, such as classification")
        ->type_name("NAMES")
        ->delimiter(',')
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    addDeviceAndReport(app, options);
    addCommonOptions(app, POINTRT_VERSION, kWrongInput, kExamples, kNotes);
}

void checkOptions(const LidarOptions& options) {
    const auto usage = [](const std::string& text) { throw Error(ExitCode::kBadUsage, text); };
    const bool finite =
        std::all_of(options.pose.begin(), options.pose.end(), [](double n) { return std::isfinite(n); });
    if (!finite || (!options.pose.empty() && options.pose.size() != 3 && options.pose.size() != 6))
        usage("--pose: must be three or six finite numbers, X,Y,Z or X,Y,Z,YAW,PITCH,ROLL");
    if (options.metres_per_unit < 0 || std::isnan(options.metres_per_unit)) usage("--metres-per-unit: must be above 0");
    if (options.output == "-") usage("-o -: how many points there are is known at their end; let a file take them");
    std::vector<std::string> inputs{options.sensor};
    if (!options.trajectory.empty()) inputs.push_back(options.trajectory);
    checkCommonOptions(options, inputs, "points");
}

} // namespace

std::optional<int> parseLidarOptions(int argc, const char* const* argv, LidarOptions& options) {
    CommandLine app(kAbout, kName);
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
    CommandLine app(kAbout, kName);
    addOptions(app, options);
    return describe(app);
}

} // namespace pointrt
