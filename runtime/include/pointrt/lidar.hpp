// SPDX-License-Identifier: Apache-2.0
// Simulated laser scanners: what one of them would measure of a scene, from one place or along a trajectory.
//
//   const pointrt::LidarSensor sensor = pointrt::readLidarSensor("street.toml").sensor;
//   pointrt::LidarRun run{.trajectory = {{.position = {500064, 4500064, 102}}}};
//   pointrt::simulateLidar(scene, sensor, run, [](const pointrt::LidarPoints& points) { ... });
//
// A scanner's own frame: x forwards, y to the left, z up. Azimuths turn from x towards y, elevations rise from the xy
// plane. Lengths of sensors are in metres, positions in the scan's coordinates. A run's points depend on the scene, the
// sensor, the run's times and its seed alone: not on threads, nor on how rays are put together.
// Everything throws TraceError or std::bad_alloc.
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

/// Beams above each other, which turn about z: all of them fire together, at one azimuth after the other.
struct LidarSpinning {
    std::vector<double> elevations_deg; ///< of each beam, which is its ring; -90 to 90
    double rotation_hz = 0;             ///< above 0
    double step_deg = 0;                ///< between firings; above 0, up to 360
    double start_deg = 0;               ///< azimuth of the first one
    bool clockwise = false;             ///< seen from above
};

/// All pixels of a picture at once: a pinhole camera along x, rows from the top, pixels from the left.
struct LidarFlash {
    std::uint32_t width = 0, height = 0;  ///< pixels, 1 to 65536; a row is a ring
    double width_deg = 0, height_deg = 0; ///< field of view, from edge to edge; above 0, below 180
    double frame_hz = 0;                  ///< above 0
};

/// One beam downwards, which a mirror swings across the flight, from left to right and back.
struct LidarOscillating {
    double field_of_view_deg = 0; ///< from side to side; above 0, below 180
    double scan_hz = 0;           ///< there and back; above 0
    double pulse_hz = 0;          ///< above 0
    bool sinusoidal = false;      ///< the angle is a sine of time; else it changes evenly, a zigzag
};

struct LidarBeam {
    double azimuth_deg = 0;
    double elevation_deg = 0; ///< -90 to 90
    std::uint16_t ring = 0;
    double delay_s = 0; ///< behind the start of its pattern; 0 or more
};

/// Any directions, one after the other, again and again.
struct LidarTable {
    std::vector<LidarBeam> beams;
    double repeat_hz = 0; ///< patterns a second; above 0
};

using LidarPattern = std::variant<LidarSpinning, LidarFlash, LidarOscillating, LidarTable>;

/// Which of a pulse's returns are kept; their numbers are counted among those.
enum class LidarKept { kAll, kFirst, kLast, kStrongest };

/// How much of the light a surface sends back, 0 to 1, as of a perfectly white one. Shapes of scene files have value.
struct LidarReflectance {
    enum class Source {
        kScan,      ///< the attribute "intensity" where the scene has it, else colour
        kColor,     ///< Rec. 709 luminance of the splat's colour in linear light
        kAttribute, ///< a number of the scan's
        kConstant,  ///< value
    };
    Source source = Source::kScan;
    double value = 1;      ///< of kConstant, and of shapes
    std::string attribute; ///< of kAttribute
    double white = 0;      ///< the attribute's number for 1; 0: the highest that the scan has
};

struct LidarSensor {
    LidarPattern pattern;

    double min_range_m = 0;       ///< what is nearer sends nothing back, and hides what is behind it
    double max_range_m = 0;       ///< what is farther is not seen
    double range_noise_m = 0;     ///< standard deviation (Gaussian) ...
    double range_noise_per_m = 0; ///< ... and what a metre of range adds to it

    double divergence_mrad = 0;    ///< of the beam, from edge to edge, where the light is 1 / e^2 of the middle's
    std::uint32_t rays = 1;        ///< the beam is traced with; 1 is its axis alone. At most 4096
    double range_resolution_m = 0; ///< what lies nearer together than this is one return; above 0 with several rays
    LidarKept kept = LidarKept::kAll;
    std::uint32_t most_returns = 5; ///< of a pulse, nearest first; 1 to 15

    LidarReflectance reflectance;
    /// Power 1 is what a white surface sends back that faces the whole beam at this range; 0: half of max_range_m.
    double reference_range_m = 0;
    double white_intensity = 4096;  ///< intensity of power 1; above 0. Intensities end at 65535
    bool range_corrected = false;   ///< intensities are told as if all was at the reference range
    double detection_threshold = 0; ///< power below which a return is not noticed
    double drop_probability = 0;    ///< of a pulse to bring nothing at all
};

/// Where a scanner is, and how it stands.
struct LidarPose {
    double time = 0; ///< seconds, of any clock
    std::array<double, 3> position{};
    std::array<double, 4> rotation{0, 0, 0, 1}; ///< quaternion x y z w, scan's from scanner's frame; any length but 0
};

/// yaw about z, then pitch about the new y, then roll about the new x, in degrees and counterclockwise seen against
/// each axis: a positive pitch lowers the front, a positive roll lifts the left side.
std::array<double, 4> lidarRotation(double yaw_deg, double pitch_deg, double roll_deg);

struct LidarRun {
    /// One pose: the scanner stands still. Several, times increasing: it moves along them, positions evenly and
    /// rotations by the shortest turn (slerp, Shoemake 1985).
    std::vector<LidarPose> trajectory;
    std::optional<double> start_s;    ///< by default the first pose's time
    std::optional<double> duration_s; ///< above 0; by default to the last pose, for one pose a single pattern
    std::uint64_t seed = 0;           ///< of all that is random
    double metres_per_unit = 0;       ///< of the scan; 0: as it says itself, and 1 where it does not
    std::size_t rays_at_once = std::size_t{1} << 20; ///< four chunks of the library's; results do not depend on it
};

/// Returns of some consecutive pulses, a row each, in the order of pulses and of ranges.
struct LidarPoints {
    std::vector<double> positions;                ///< [N][3], the scan's coordinates; on the beam's axis
    std::vector<double> times;                    ///< [N], of the pulse, seconds
    std::vector<double> ranges;                   ///< [N], in units of the scan, noise and all
    std::vector<std::uint16_t> intensities;       ///< [N]
    std::vector<float> powers;                    ///< [N], before it became an intensity
    std::vector<float> incidences_deg;            ///< [N], between the beam's axis and the surface's normal, 0 to 90
    std::vector<float> scan_angles_deg;           ///< [N], of the mirror, positive to the right; 0 for other patterns
    std::vector<std::uint8_t> return_numbers;     ///< [N], from 1
    std::vector<std::uint8_t> numbers_of_returns; ///< [N]
    std::vector<std::uint16_t> rings;             ///< [N]
    std::vector<std::uint64_t> pulses;            ///< [N], from 0
    std::vector<std::uint32_t> splat_ids;         ///< [N], of the splat that sent back most of it; kNoHit for a shape
    std::vector<std::uint32_t> instance_ids;      ///< [N]
    std::vector<std::uint32_t> tile_ids; ///< [N], as castRays tells them; empty where the scene has no tile sets

    std::uint64_t pulses_done = 0, pulses_total = 0; ///< of the run, these included

    std::size_t size() const { return times.size(); }
    /// Puts other's points behind these, and takes what it says of pulses.
    void append(const LidarPoints& other);
    /// Keeps the room that they took.
    void clear();
};

/// Pulses that a run fires. Throws kBadUsage for sensors and runs that are none.
std::uint64_t lidarPulseCount(const LidarSensor& sensor, const LidarRun& run);

/// Measures scene and hands the points to take, block by block, in memory that does not grow with the number of pulses.
/// What take throws ends it. Throws kBadUsage for a sensor or a run that is none, kCannotRun for a lost device.
///
/// Beams: sub-rays on a spiral of golden angles (Vogel 1979) that hold equal shares of a Gaussian beam's power within
/// its 1 / e^2 cone, turned at random for each pulse. What they hit is sorted by range and parted where the next hit is
/// more than the range resolution away: each part is a return, at the mean of its ranges, weighted by power.
/// Power: reflectance * cos(incidence) * (reference range / range)^2, the lidar equation of extended Lambertian targets
/// (Wagner et al. 2006; Hoefle and Pfeifer 2007), times the share of the rays that hit.
/// Random numbers: Philox4x32-10 (Salmon et al. 2011), counted by pulse; Gaussian ones after Box and Muller 1958.
void simulateLidar(const TraceScene& scene, const LidarSensor& sensor, const LidarRun& run,
                   const std::function<void(const LidarPoints&)>& take);

/// What a sensor file (docs/RAYS.md, "A simulated scanner") says.
struct LidarSensorFile {
    LidarSensor sensor;
    std::vector<LidarPose> trajectory; ///< of its pose or trajectory; empty where it has none
};

/// Throws kBadInput "FILE:LINE: key: reason". Files that it names are looked for beside it.
LidarSensorFile readLidarSensor(const std::string& path);
/// The same of text. @param path for messages, and for what the text names
LidarSensorFile parseLidarSensor(std::string_view text, const std::string& path);

/// Poses of a text file: a line that names the columns, t x y z and qx qy qz qw, or yaw pitch roll in degrees; then a
/// line each. Throws kBadInput "FILE:LINE: reason", where times do not increase, too.
std::vector<LidarPose> readLidarTrajectory(const std::string& path);

} // namespace pointrt
