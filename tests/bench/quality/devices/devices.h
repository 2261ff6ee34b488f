// SPDX-License-Identifier: Apache-2.0
// Simulated devices. Their numbers come from data sheets and papers, named beside each; none is fitted to what
// pointrt-bake makes of it. All metres and radians; the same seed gives the same scan.
#pragma once

#include "tests/bench/quality/devices/random.h"
#include "tests/bench/quality/devices/scans.h"
#include "tests/bench/quality/devices/world.h"

namespace pointrt::quality {

/// Laser stripe scanner with a turntable: a sheet of light moves across the object, a camera sees where the stripe
/// lies. Where the sheet is cut by an edge, or lies on two surfaces, the middle of what the camera sees of it is not
/// where the sheet's middle is: ranges curl (Curless and Levoy, "Better optical triangulation through spacetime
/// analysis", 1995).
struct Triangulation {
    /// Between the sheet and the camera's sight. Curless and Levoy 1995 give 30 degrees as typical of commercial
    /// scanners such as the Cyberware 3030.
    double angle_deg = 30;
    /// From column to column and from row to row: "echo_lgincr 0.0005" in the headers of the Stanford Bunny's scans.
    double pitch = 0.0005;
    /// Half the sheet's width to 1/e^2 of its light. Assumed: sheets are about two columns wide, narrower ones would
    /// not be sampled (the same paper's requirement on the beam's width).
    double half_width = 0.0005;
    /// Standard deviation along the sight: the depth resolution of Levoy et al., "The Digital Michelangelo Project",
    /// 2000.
    double noise = 0.00005;
    /// Share of a full stripe's light that the camera still finds. Assumed.
    double least_power = 0.25;
    /// Standard deviations of a pose. Assumed: half a column, what ICP leaves of scans as noisy as these, and the angle
    /// that gives as much at the end of 0.2 m.
    double pose_offset = 0.00025, pose_turn_deg = 0.1;
};
/// Views around the upright axis and from above on the object about the origin, whose radius is that.
std::vector<GridScan> scanByTriangulation(const WorldTracing& world, const Triangulation& device, double radius,
                                          std::uint64_t seed);

/// Kinect of 2010. K. Khoshelham and S. Oude Elberink, "Accuracy and resolution of Kinect depth data for indoor mapping
/// applications", Sensors 12, 2012: focal length 5.453 mm at 9.3 micrometres a pixel, base 75 mm, disparity in whole
/// steps of 2.85e-5 / cm of inverse depth with a standard deviation of half a step, 0.5 to 5 m.
struct DepthCamera {
    int columns = 640, rows = 480;
    double focal = 5.453 / 0.0093; ///< pixels
    double base = 0.075;           ///< to the projector, which lies to the right
    double step = 2.85e-3;         ///< of inverse depth, 1/m
    double noise_steps = 0.5;
    double nearest = 0.5, farthest = 5;
    /// Standard deviation of where a pixel looks: Nguyen, Izadi and Lovell, "Modeling Kinect sensor noise for improved
    /// 3D reconstruction and tracking", 2012.
    double lateral_pixels = 0.8;
};
/// The world in the camera's frame: x to the right, y down, z ahead.
GridScan scanByDepthCamera(const WorldTracing& world, const DepthCamera& device, std::uint64_t seed);
/// A depth as the device tells it: its disparity with that error, in steps, rounded.
double quantizedDepth(const DepthCamera& device, double depth, double error_steps);

/// Phase scanner on a tripod; where the beam meets two surfaces it tells a range between them (Hebert and Krotkov, "3D
/// measurements from imaging laser radars: how good are they?", 1992). FARO Focus3D X 330, data sheet of 2013.
struct TerrestrialScanner {
    double step_deg = 360.0 / 1280;   ///< the coarsest of its resolutions: 1/32 of 40960 points a turn
    double lowest_deg = -60;          ///< 300 degrees vertically, blind below itself
    double exit_radius = 0.00225 / 2; ///< 2.25 mm to 1/e at the exit
    double half_divergence = 0.00019; ///< 0.19 mrad to 1/e, half angle
    double noise = 0.0005;            ///< 0.5 mm at 25 m on 10% of reflectivity
    double nearest = 0.6, farthest = 330;
    /// Share of a full beam's light that still gives a range. Assumed.
    double least_power = 0.05;
    /// Standard deviation of a station's place: what target-based registration leaves. Assumed.
    double pose_offset = 0.002;
};
GridScan scanByTerrestrial(const WorldTracing& world, const TerrestrialScanner& device, const Vec3d& station,
                           std::uint64_t seed);

/// Airborne full-waveform scanner in strips along x. RIEGL LMS-Q560, data sheet of 2010.
struct AirborneScanner {
    double half_divergence = 0.00025; ///< 0.5 mrad in all
    double half_scan_deg = 22.5;      ///< 45 degrees in all
    double noise = 0.02;              ///< accuracy 20 mm
    double resolution = 0.5;          ///< between two targets
    double altitude = 500;            ///< of a survey of a town at its 200 kHz and more
    /// Between pulses along and across: 8 points/m^2, quality level 1 of the USGS Lidar Base Specification 2022.
    double pitch = 0.35;
    /// Standard deviation of a strip's place: Applanix POS AV 510, 0.05 m after processing.
    double pose_offset = 0.05;
    double least_power = 0.05; ///< of a return, as a share of a full one. Assumed.
};
/// Strips beside and against each other over the square that reaches so far from the origin.
std::vector<Return> scanByAirborne(const WorldTracing& world, const AirborneScanner& device, double half,
                                   std::uint64_t seed);

/// 32 lasers that turn on the roof of a car. Velodyne HDL-32E, data sheet and manual of 2010 to 2018.
struct SpinningLidar {
    int rings = 32;
    double top_deg = 10.67, bottom_deg = -30.67; ///< 1.33 degrees apart
    double azimuth_step_deg = 0.33;              ///< at 20 turns a second
    double noise = 0.02;                         ///< accuracy 2 cm, one standard deviation, at 25 m
    double half_divergence = 0.0015;             ///< 3 mrad in all
    double nearest = 1, farthest = 70;
    double resolution = 0.3;   ///< between two targets of which the stronger is told. Assumed: a pulse of 2 ns.
    double least_power = 0.05; ///< assumed
    /// Standard deviations of where a turn was taken: OXTS RT3003 of Geiger et al., "Vision meets robotics: the KITTI
    /// dataset", 2013: 0.02 m and 0.1 degrees.
    double pose_offset = 0.02, pose_turn_deg = 0.1;
};
/// Turns at places of the car's way, in the world's frame.
std::vector<Vec3d> scanBySpinning(const WorldTracing& world, const SpinningLidar& device,
                                  const std::vector<Vec3d>& places, std::uint64_t seed);

/// Patch-based multi-view stereo. Seitz et al., "A comparison and evaluation of multi-view stereo reconstruction
/// algorithms", 2006: an object of 0.16 m at 0.25 mm a pixel; Furukawa and Ponce, "Accurate, dense, and robust
/// multi-view stereopsis", 2010: 90% of its points within 0.49 mm, a patch on every 2 x 2 pixels, seen in at least 3
/// pictures.
struct Photogrammetry {
    double longest = 0.16;           ///< of the object
    double pitch = 0.0005;           ///< 2 pixels
    double noise = 0.00049 / 1.645;  ///< along the sight; 90% are within 1.645 standard deviations
    double lateral_noise = 0.000125; ///< half a pixel. Assumed.
    int cameras = 47;                ///< of "temple ring"
    int least_views = 3;
    double largest_slope_deg = 60; ///< of a patch against the sight: PMVS's own bound
    /// Share of patches matched wrongly, which lie anywhere along their sight within half the object, and of surface
    /// without texture to match. Assumed.
    double stray_share = 0.01, bare_share = 0.05;
};
std::vector<Vec3d> scanByPhotogrammetry(const WorldTracing& world, const Photogrammetry& device, std::uint64_t seed);

} // namespace pointrt::quality
