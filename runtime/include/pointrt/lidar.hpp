// SPDX-License-Identifier: Apache-2.0
// Simulated laser scanners: measures a scene from a fixed position or along a trajectory.
//
//   const pointrt::LidarSensor sensor = pointrt::readLidarSensor("street.toml").sensor;
//   pointrt::LidarRun run{.trajectory = {{.position = {500064, 4500064, 102}}}};
//   pointrt::simulateLidar(scene, sensor, run, [](const pointrt::LidarPoints& points) { ... });
//
// The scanner's frame: x forward, y left, z up. Azimuths increase from x towards y, elevations upward from the xy
// plane. Sensor lengths are in metres, positions in the scan's coordinates. Points depend only on the scene, the sensor
// and the run, not on the number of threads or the batch size. Everything throws TraceError or std::bad_alloc.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "pointrt/trace.hpp"

namespace pointrt {

/// A spinning scanner: stacked beams that rotate about z and fire together at successive azimuths.
struct LidarSpinning {
    std::vector<double> elevations_deg; ///< of each beam, indexed by ring; -90 to 90
    double rotation_hz = 0;             ///< above 0
    double step_deg = 0;                ///< azimuth between firings; above 0, up to 360
    double start_deg = 0;               ///< azimuth of the first firing
    bool clockwise = false;             ///< seen from above
};

/// A flash lidar: fires all pixels of a pinhole camera that looks along x at once, rows from the top, pixels from the
/// left.
struct LidarFlash {
    std::uint32_t width = 0, height = 0;  ///< pixels, 1 to 65536; a row is a ring
    double width_deg = 0, height_deg = 0; ///< field of view, from edge to edge; above 0, below 180
    double frame_hz = 0;                  ///< above 0
};

/// An oscillating-mirror scanner: one downward beam that swings across the flight direction, left to right and back.
struct LidarOscillating {
    double field_of_view_deg = 0; ///< from side to side; above 0, below 180
    double scan_hz = 0;           ///< full cycles, left to right and back; above 0
    double pulse_hz = 0;          ///< above 0
    bool sinusoidal = false;      ///< true: the angle is a sine of time; false: a triangle wave
};

struct LidarBeam {
    double azimuth_deg = 0;
    double elevation_deg = 0; ///< -90 to 90
    std::uint16_t ring = 0;
    double delay_s = 0; ///< after the start of the pattern; 0 or more
};

/// A table of beams, repeated.
struct LidarTable {
    std::vector<LidarBeam> beams;
    double repeat_hz = 0; ///< patterns per second; above 0
};

using LidarPattern = std::variant<LidarSpinning, LidarFlash, LidarOscillating, LidarTable>;

/// The returns of a pulse to keep; return numbers count only these.
enum class LidarKept { kAll, kFirst, kLast, kStrongest };

/// The reflectance of surfaces, 0 to 1. Shapes of scene files always have the constant `value`.
struct LidarReflectance {
    enum class Source {
        kScan,      ///< the attribute "intensity" if the scene has it, else the colour
        kColor,     ///< Rec. 709 luminance of the splat's colour in linear light
        kAttribute, ///< another attribute
        kConstant,  ///< value
    };
    Source source = Source::kScan;
    double value = 1;      ///< for kConstant, and for shapes
    std::string attribute; ///< for kAttribute
    double white = 0;      ///< the attribute's value for reflectance 1; 0: its maximum in the scan
};

struct LidarSensor {
    LidarPattern pattern;

    double min_range_m = 0;       ///< nearer surfaces return nothing, but occlude
    double max_range_m = 0;       ///< farther surfaces return nothing
    double range_noise_m = 0;     ///< standard deviation of Gaussian range noise ...
    double range_noise_per_m = 0; ///< ... and its increase per metre of range

    double divergence_mrad = 0;    ///< full angle of the beam, at 1 / e^2 of the central irradiance
    std::uint32_t rays = 1;        ///< rays per pulse, 1 to 4096; 1 traces the beam's axis only
    double range_resolution_m = 0; ///< hits closer together merge into one return; above 0 if rays > 1
    LidarKept kept = LidarKept::kAll;
    std::uint32_t most_returns = 5; ///< maximum per pulse, nearest first; 1 to 15

    LidarReflectance reflectance;
    /// The range at which a white surface that faces the beam and fills it returns power 1; 0: half of max_range_m.
    double reference_range_m = 0;
    double white_intensity = 4096;  ///< intensity of power 1; above 0. Intensities are clamped to 65535
    bool range_corrected = false;   ///< normalise intensities to the reference range
    double detection_threshold = 0; ///< smallest power of a detected return
    double drop_probability = 0;    ///< probability that a pulse has no returns
};

/// The pose of a scanner at a time.
struct LidarPose {
    double time = 0; ///< seconds, any epoch
    std::array<double, 3> position{};
    std::array<double, 4> rotation{0, 0, 0, 1}; ///< scan_from_scanner, quaternion x y z w; any length but 0
};

/// The quaternion of yaw about z, then pitch about the new y, then roll about the new x, counterclockwise if the axis
/// points to the viewer: positive pitch lowers the front, positive roll lifts the left side.
std::array<double, 4> lidarRotation(double yaw_deg, double pitch_deg, double roll_deg);

struct LidarRun {
    /// One pose: a fixed scanner. Several, with increasing times: positions are interpolated linearly, rotations by
    /// slerp (Shoemake 1985).
    std::vector<LidarPose> trajectory;
    std::optional<double> start_s;    ///< default: the time of the first pose
    std::optional<double> duration_s; ///< above 0; default: to the last pose, or one pattern for a single pose
    std::uint64_t seed = 0;           ///< random seed
    double metres_per_unit = 0;       ///< of the scan's coordinates; 0: from the scan, else 1
    std::size_t rays_at_once = std::size_t{1} << 20; ///< batch size, four chunks of castRays; does not affect results
};

/// The returns of consecutive pulses, one row each, ordered by pulse and range.
struct LidarPoints {
    std::vector<double> positions;                ///< [N][3], in the scan's coordinates, on the beam's axis
    std::vector<double> times;                    ///< [N], of the pulse, seconds
    std::vector<double> ranges;                   ///< [N], in units of the scan, with noise
    std::vector<std::uint16_t> intensities;       ///< [N]
    std::vector<float> powers;                    ///< [N], not scaled or clamped
    std::vector<float> incidences_deg;            ///< [N], angle between the beam's axis and the normal, 0 to 90
    std::vector<float> scan_angles_deg;           ///< [N], of the mirror, positive to the right; 0 for other patterns
    std::vector<std::uint8_t> return_numbers;     ///< [N], from 1
    std::vector<std::uint8_t> numbers_of_returns; ///< [N]
    std::vector<std::uint16_t> rings;             ///< [N]
    std::vector<std::uint64_t> pulses;            ///< [N], from 0
    std::vector<std::uint32_t> splat_ids;         ///< [N], the splat with the largest share; kNoHit for a shape
    std::vector<std::uint32_t> instance_ids;      ///< [N]
    std::vector<std::uint32_t> tile_ids;          ///< [N], as in castRays; empty if the scene has no tile sets

    std::uint64_t pulses_done = 0, pulses_total = 0; ///< progress of the run, including this block

    std::size_t size() const { return times.size(); }
    /// Appends other's points, and copies its pulse counts.
    void append(const LidarPoints& other);
    /// Removes all points but keeps their memory.
    void clear();
};

/// The number of pulses of a run. Throws kBadUsage for an invalid sensor or run.
std::uint64_t lidarPulseCount(const LidarSensor& sensor, const LidarRun& run);

/// Simulates a run and passes its points to `take`, block by block, in bounded memory. An exception from `take` ends
/// the run. Throws kBadUsage for an invalid sensor or run, kCannotRun if the device is lost.
///
/// Beams: sub-rays on a golden-angle spiral (Vogel 1979), with equal shares of a Gaussian beam's power within its 1 /
/// e^2 cone, rotated randomly for each pulse. Their hits are sorted by range and split at gaps larger than the range
/// resolution: each group is a return, at the power-weighted mean of its ranges.
/// Power: reflectance * cos(incidence) * (reference range / range)^2, the lidar equation of extended Lambertian targets
/// (Wagner et al. 2006; Hoefle and Pfeifer 2007), times the share of the rays that hit.
/// Random numbers: Philox4x32-10 (Salmon et al. 2011), keyed by pulse; Gaussian ones by Box and Muller (1958).
void simulateLidar(const TraceScene& scene, const LidarSensor& sensor, const LidarRun& run,
                   const std::function<void(const LidarPoints&)>& take);

/// The contents of a sensor file (docs/RAYS.md, "A simulated scanner").
struct LidarSensorFile {
    LidarSensor sensor;
    std::vector<LidarPose> trajectory; ///< its pose or trajectory; empty if it has none
};

/// Reads a sensor file; files that it names are relative to its folder. Throws kBadInput "FILE:LINE: key: reason".
LidarSensorFile readLidarSensor(const std::string& path);
/// The same for the text of a sensor file. @param path for messages, and to find files that the text names
LidarSensorFile parseLidarSensor(std::string_view text, const std::string& path);

/// Reads poses from a text file: a header line with the columns t x y z and qx qy qz qw, or yaw pitch roll in degrees,
/// then a line per pose. Throws kBadInput "FILE:LINE: reason", also if times do not increase.
std::vector<LidarPose> readLidarTrajectory(const std::string& path);

} // namespace pointrt
