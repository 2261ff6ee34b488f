// SPDX-License-Identifier: Apache-2.0
// Simulated devices. Their parameters come from the data sheets and papers cited with each; none is fitted to results
// of pointrt-bake. Metres and radians; the same seed gives the same scan.
#pragma once

#include "tests/bench/quality/devices/random.h"
#include "tests/bench/quality/devices/scans.h"
#include "tests/bench/quality/devices/world.h"

namespace pointrt::quality {

/// Laser stripe scanner with a turntable: a sheet of light moves across the object, and a camera sees the stripe. If an
/// edge cuts the sheet, or it is on two surfaces, the centre of the visible stripe is not the centre of the sheet:
/// ranges curl (Curless and Levoy, "Better optical triangulation through spacetime analysis", 1995).
struct Triangulation {
    /// Between the sheet and the camera's axis. Curless and Levoy 1995 give 30 degrees as typical of commercial
    /// scanners such as the Cyberware 3030.
    double angle_deg = 30;
    /// Distance between columns and between rows: "echo_lgincr 0.0005" in the headers of the Stanford Bunny's scans.
    double pitch = 0.0005;
    /// Half the sheet's width at 1/e^2 of its light. Assumed: about two columns, as narrower sheets would be
    /// undersampled (the same paper's requirement on the beam's width).
    double half_width = 0.0005;
    /// Standard deviation along the line of sight: the depth resolution of Levoy et al., "The Digital Michelangelo
    /// Project", 2000.
    double noise = 0.00005;
    /// Least detectable share of a full stripe's light. Assumed.
    double least_power = 0.25;
    /// Standard deviations of a pose. Assumed: half a column, the residual of ICP for such noise, and the angle that
    /// gives the same at 0.2 m.
    double pose_offset = 0.00025, pose_turn_deg = 0.1;
};
/// Views around the vertical axis and from above, of an object of this radius at the origin.
std::vector<GridScan> scanByTriangulation(const WorldTracing& world, const Triangulation& device, double radius,
                                          std::uint64_t seed);

/// Kinect of 2010. K. Khoshelham and S. Oude Elberink, "Accuracy and resolution of Kinect depth data for indoor mapping
/// applications", Sensors 12, 2012: focal length 5.453 mm at 9.3 micrometres per pixel, base 75 mm, disparity in whole
/// steps of 2.85e-5 / cm of inverse depth with a standard deviation of half a step, 0.5 to 5 m.
struct DepthCamera {
    int columns = 640, rows = 480;
    double focal = 5.453 / 0.0093; ///< pixels
    double base = 0.075;           ///< to the projector, on the right
    double step = 2.85e-3;         ///< of inverse depth, 1/m
    double noise_steps = 0.5;
    double nearest = 0.5, farthest = 5;
    /// Standard deviation of a pixel's direction: Nguyen, Izadi and Lovell, "Modeling Kinect sensor noise for improved
    /// 3D reconstruction and tracking", 2012.
    double lateral_pixels = 0.8;
};
/// The world is in the camera's frame: x to the right, y down, z ahead.
GridScan scanByDepthCamera(const WorldTracing& world, const DepthCamera& device, std::uint64_t seed);
/// A depth as the device reports it: its disparity plus this error, in steps, rounded.
double quantizedDepth(const DepthCamera& device, double depth, double error_steps);

/// Phase scanner on a tripod; if the beam hits two surfaces, it reports a range between them (Hebert and Krotkov, "3D
/// measurements from imaging laser radars: how good are they?", 1992). FARO Focus3D X 330, data sheet of 2013.
struct TerrestrialScanner {
    double step_deg = 360.0 / 1280;   ///< the coarsest resolution: 1/32 of 40960 points per turn
    double lowest_deg = -60;          ///< 300 degrees vertically; blind below
    double exit_radius = 0.00225 / 2; ///< 2.25 mm at 1/e, at the exit
    double half_divergence = 0.00019; ///< 0.19 mrad at 1/e, half angle
    double noise = 0.0005;            ///< 0.5 mm at 25 m and 10% reflectivity
    double nearest = 0.6, farthest = 330;
    /// Least share of a full beam's light for a range. Assumed.
    double least_power = 0.05;
    /// Standard deviation of a station's position, after target-based registration. Assumed.
    double pose_offset = 0.002;
};
GridScan scanByTerrestrial(const WorldTracing& world, const TerrestrialScanner& device, const Vec3d& station,
                           std::uint64_t seed);

/// Airborne full-waveform scanner in strips along x. RIEGL LMS-Q560, data sheet of 2010.
struct AirborneScanner {
    double half_divergence = 0.00025; ///< 0.5 mrad full angle
    double half_scan_deg = 22.5;      ///< 45 degrees full angle
    double noise = 0.02;              ///< accuracy 20 mm
    double resolution = 0.5;          ///< between two targets
    double altitude = 500;            ///< for surveys of towns at its 200 kHz and more
    /// Between pulses along and across: 8 points/m^2, quality level 1 of the USGS Lidar Base Specification 2022.
    double pitch = 0.35;
    /// Standard deviation of a strip's position: Applanix POS AV 510, 0.05 m after processing.
    double pose_offset = 0.05;
    double least_power = 0.05; ///< least power of a return, as a share of a full one. Assumed.
};
/// Adjacent strips in alternating directions over the square with this half edge around the origin.
std::vector<Return> scanByAirborne(const WorldTracing& world, const AirborneScanner& device, double half,
                                   std::uint64_t seed);

/// 32 rotating lasers on the roof of a car. Velodyne HDL-32E, data sheet and manual of 2010 to 2018.
struct SpinningLidar {
    int rings = 32;
    double top_deg = 10.67, bottom_deg = -30.67; ///< 1.33 degrees apart
    double azimuth_step_deg = 0.33;              ///< at 20 turns per second
    double noise = 0.02;                         ///< accuracy 2 cm, one standard deviation, at 25 m
    double half_divergence = 0.0015;             ///< 3 mrad full angle
    double nearest = 1, farthest = 70;
    double resolution = 0.3;   ///< between two targets, of which the stronger is reported. Assumed: a pulse of 2 ns.
    double least_power = 0.05; ///< assumed
    /// Standard deviations of the pose of a turn: OXTS RT3003 of Geiger et al., "Vision meets robotics: the KITTI
    /// dataset", 2013: 0.02 m and 0.1 degrees.
    double pose_offset = 0.02, pose_turn_deg = 0.1;
};
/// Turns at positions along the car's path, in the world's frame.
std::vector<Vec3d> scanBySpinning(const WorldTracing& world, const SpinningLidar& device,
                                  const std::vector<Vec3d>& places, std::uint64_t seed);

/// Patch-based multi-view stereo. Seitz et al., "A comparison and evaluation of multi-view stereo reconstruction
/// algorithms", 2006: an object of 0.16 m at 0.25 mm per pixel; Furukawa and Ponce, "Accurate, dense, and robust
/// multi-view stereopsis", 2010: 90% of its points within 0.49 mm, a patch on every 2 x 2 pixels, seen in at least 3
/// pictures.
struct Photogrammetry {
    double longest = 0.16;           ///< of the object
    double pitch = 0.0005;           ///< 2 pixels
    double noise = 0.00049 / 1.645;  ///< along the line of sight; 90% are within 1.645 standard deviations
    double lateral_noise = 0.000125; ///< half a pixel. Assumed.
    int cameras = 47;                ///< of "temple ring"
    int least_views = 3;
    double largest_slope_deg = 60; ///< of a patch to the line of sight: PMVS's own limit
    /// Share of patches matched wrongly, anywhere along their line of sight within half the object, and share of the
    /// surface without texture to match. Assumed.
    double stray_share = 0.01, bare_share = 0.05;
};
std::vector<Vec3d> scanByPhotogrammetry(const WorldTracing& world, const Photogrammetry& device, std::uint64_t seed);

} // namespace pointrt::quality
