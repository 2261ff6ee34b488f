// SPDX-License-Identifier: Apache-2.0
#include "runtime/studies/sensor_check.h"

#include <algorithm>
#include <cmath>

#include "runtime/studies/sensor_limits.h"
#include "runtime/studies/study_values.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

void requireIn(double value, LidarLimit limit, const std::string& name) {
    if (value >= limit.low && value <= limit.high) return;
    refuseUsage(name + " is " + plainText(value) + ", but must be from " + plainText(limit.low) + " to " +
                plainText(limit.high));
}

void requireCount(std::size_t value, std::size_t low, std::size_t high, const std::string& name) {
    if (value >= low && value <= high) return;
    refuseUsage(name + " is " + std::to_string(value) + ", but must be from " + std::to_string(low) + " to " +
                std::to_string(high));
}

void requirePattern(const LidarSpinning& spinning) {
    requireCount(spinning.elevations_deg.size(), 1, kMaxLidarRings, "the number of elevations_deg");
    for (const double elevation : spinning.elevations_deg) requireIn(elevation, kLidarElevations, "elevations_deg");
    requireIn(spinning.rotation_hz, kLidarRates, "rotation_hz");
    requireIn(spinning.step_deg, kLidarSteps, "step_deg");
    requireIn(spinning.start_deg, kLidarAngles, "start_deg");
}

void requirePattern(const LidarFlash& flash) {
    requireCount(flash.width, 1, kMaxLidarPixels, "width");
    requireCount(flash.height, 1, kMaxLidarPixels, "height");
    requireIn(flash.width_deg, kLidarFields, "width_deg");
    requireIn(flash.height_deg, kLidarFields, "height_deg");
    requireIn(flash.frame_hz, kLidarRates, "frame_hz");
}

void requirePattern(const LidarOscillating& mirror) {
    requireIn(mirror.field_of_view_deg, kLidarFields, "field_of_view_deg");
    requireIn(mirror.scan_hz, kLidarRates, "scan_hz");
    requireIn(mirror.pulse_hz, kLidarRates, "pulse_hz");
}

void requirePattern(const LidarTable& table) {
    requireCount(table.beams.size(), 1, kMaxLidarBeams, "the number of beams");
    requireIn(table.repeat_hz, kLidarRates, "repeat_hz");
    for (const LidarBeam& beam : table.beams) {
        requireIn(beam.azimuth_deg, kLidarAngles, "azimuth_deg");
        requireIn(beam.elevation_deg, kLidarElevations, "elevation_deg");
        requireIn(beam.delay_s, {0, 1 / table.repeat_hz}, "delay_s");
    }
}

void requireRanges(const LidarSensor& sensor) {
    requireIn(sensor.min_range_m, kLidarLengths, "min_range_m");
    requireIn(sensor.max_range_m, kLidarSomeLengths, "max_range_m");
    if (sensor.min_range_m >= sensor.max_range_m) refuseUsage("min_range_m must be below max_range_m");
    requireIn(sensor.range_noise_m, kLidarLengths, "range_noise_m");
    requireIn(sensor.range_noise_per_m, kLidarShares, "range_noise_per_m");
}

void requireReflectance(const LidarReflectance& reflectance) {
    requireIn(reflectance.value, kLidarShares, "reflectance");
    requireIn(reflectance.white, kLidarNumbers, "the white of the attribute");
    if (reflectance.source == LidarReflectance::Source::kAttribute && reflectance.attribute.empty())
        refuseUsage("the attribute of the reflectance has no name");
}

} // namespace

void requireSensor(const LidarSensor& sensor) {
    std::visit([](const auto& kind) { requirePattern(kind); }, sensor.pattern);
    requireRanges(sensor);
    requireIn(sensor.divergence_mrad, kLidarDivergences, "divergence_mrad");
    requireCount(sensor.rays, 1, kMaxLidarRays, "rays");
    requireIn(sensor.range_resolution_m, sensor.rays > 1 ? kLidarSomeLengths : kLidarLengths, "range_resolution_m");
    requireCount(sensor.most_returns, 1, kMaxLidarReturns, "most_returns");
    requireReflectance(sensor.reflectance);
    requireIn(sensor.reference_range_m, kLidarLengths, "reference_range_m");
    requireIn(sensor.white_intensity, kLidarSomeNumbers, "white_intensity");
    requireIn(sensor.detection_threshold, kLidarNumbers, "detection_threshold");
    requireIn(sensor.drop_probability, kLidarShares, "drop_probability");
}

void requireTrajectory(const std::vector<LidarPose>& trajectory) {
    if (trajectory.empty()) refuseUsage("the trajectory has no pose");
    for (std::size_t i = 0; i < trajectory.size(); ++i) {
        const LidarPose& pose = trajectory[i];
        const auto isFinite = [](double number) { return std::isfinite(number); };
        const std::string place = "pose " + std::to_string(i) + ": ";
        if (!isFinite(pose.time) || !std::all_of(pose.position.begin(), pose.position.end(), isFinite))
            refuseUsage(place + "its time or position is not finite");
        const auto& q = pose.rotation;
        const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        if (!std::isnormal(square)) refuseUsage(place + "its quaternion is 0 or not finite");
        if (i > 0 && pose.time <= trajectory[i - 1].time)
            refuseUsage(place + "its time must be later than the previous pose's");
    }
}

void requireRun(const LidarRun& run) {
    requireTrajectory(run.trajectory);
    if (run.start_s && !std::isfinite(*run.start_s)) refuseUsage("start_s is not finite");
    const double first = run.trajectory.front().time, last = run.trajectory.back().time;
    const double start = run.start_s.value_or(first);
    if (run.duration_s && !(*run.duration_s > 0 && std::isfinite(*run.duration_s)))
        refuseUsage("duration_s must be above 0 and finite");
    if (run.metres_per_unit != 0) requireIn(run.metres_per_unit, kLidarUnits, "metres_per_unit");
    if (run.trajectory.size() == 1) return;
    const std::string ends = ", but the trajectory is from " + plainText(first) + " to " + plainText(last) + " s";
    if (start < first || start >= last) refuseUsage("start_s is " + plainText(start) + ends);
    if (run.duration_s && start + *run.duration_s > last)
        refuseUsage("the run ends at " + plainText(start + *run.duration_s) + " s" + ends);
}

} // namespace pointrt
