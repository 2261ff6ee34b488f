// SPDX-License-Identifier: Apache-2.0
// Studies of scans: how long the sun shines on points, how much of the sky they see, who sees them.
//
//   const pointrt::TraceDevice device;
//   const pointrt::TraceScene scene(device, {"roof.pro"});
//   const pointrt::ScanPoints points = pointrt::scanPoints("roof.pro");
//   const pointrt::StudyFrame frame = pointrt::studyFrame("roof.pro", {47.4, 8.5});
//   std::vector<double> hours(points.radii.size());
//   const pointrt::Lights sun = pointrt::sunLights({{47.4, 8.5}, {2026, 6, 21}, {2026, 6, 21}}, frame);
//   pointrt::sumLights(scene, points.rows(), sun, {.sides = points.sides(), .up = frame.up}, hours);
//
// A point is a disc, or a place in the air. Its rays start on its disc, a quarter of its radius up on the side that
// they leave it by. What they meet on the way out of the surface that it lies in is that surface, not something in the
// way: a disc met lower than 3 radii over the point's own (or 5 standard deviations of its noise), parallel to it
// within 60 degrees and crossed the way that its own was left. These are the rules by which pictures leave surfaces
// (shaders/trace/offset.glsl), but for rays that hardly rise: here they are in their own surface until they are as
// high, at less than 2 degrees as far as at 2.
//
// All of it may be used from several threads at once, and throws TraceError or std::bad_alloc.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pointrt/trace.hpp"

namespace pointrt {

/// What a study asks about: a row for each point in each array, in the scan's coordinates and unit.
struct StudyPoints {
    std::span<const double> positions;   ///< [N][3]
    std::span<const float> normals = {}; ///< [N][3], any length; empty, or rows of 0: the point lies level
    std::span<const float> radii = {};   ///< [N], of its disc; empty: StudyRules::radius
    std::span<const float> noise = {};   ///< [N], standard deviation of the surface; empty: 0
};

/// The splats of a .pro file as points, in its order.
struct ScanPoints {
    std::vector<double> positions;
    std::vector<float> normals, radii, noise; ///< noise empty where the scan is clean
    bool oriented = false;                    ///< normals say which side is outside

    StudyPoints rows() const { return {positions, normals, radii, noise}; }
};

/// Throws TraceError "FILE: reason": kBadInput, or kCannotRun where memory lacks.
ScanPoints scanPoints(const std::string& path);

/// Points of a scene, with where each comes from, as castRays tells hits.
struct ScenePoints : ScanPoints {
    std::vector<std::uint32_t> splat_ids, instance_ids;
    std::vector<std::uint32_t> tile_ids; ///< kNoHit but for those of sets
};

/// The points of a scene as TraceScene takes it, some at a time, so that memory has to hold no more of it: instance by
/// instance, in the world's coordinates. Of a .pro all splats in its order; of a tile set those of its original tiles'
/// cores, each once, tile by tile. One file is open at a time. For one thread.
class ScenePointReader {
public:
    /// A block of this many is traced fast.
    static constexpr std::size_t kPoints = std::size_t{1} << 19;

    /// Throws as TraceScene does for its paths.
    explicit ScenePointReader(const std::vector<std::string>& paths);
    ~ScenePointReader();
    ScenePointReader(ScenePointReader&&) noexcept;
    ScenePointReader& operator=(ScenePointReader&&) noexcept;

    /// The next ones, up to most, in place of those in points; false where there are none any more. oriented is left
    /// out: sidesOf tells of all. Throws kBadInput for a file that cannot be read.
    bool next(ScenePoints& points, std::size_t most = kPoints);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Half of the radii of a scene's splats are smaller, of some ten thousand of them: for points that have none. 0 where
/// there are none. Throws as ScenePointReader.
double medianRadius(const std::vector<std::string>& paths);

/// Which side of a point's disc counts.
enum class Sides {
    kFront, ///< what shines on it, or looks at it, from behind its normal does not: right where normals can be trusted
    kBoth,  ///< either: for leaves, wires, and scans whose normals are not oriented
};

/// kFront where the normals of all files of the scene are oriented, else kBoth. Throws as ScenePointReader.
Sides sidesOf(const std::vector<std::string>& paths);

/// Up by a .pro file, a tile set or a scene file, of whose instances the first one counts that says where the scene
/// does not: a unit vector, +Z where nothing says. Throws as ScenePointReader.
std::array<double, 3> scanUp(const std::string& path);

struct StudyRules {
    Sides sides = Sides::kFront;       ///< points without a normal count from both
    std::array<double, 3> up{0, 0, 1}; ///< of points without a normal
    double radius = 0;                 ///< of points without one; 0: their rays start where they are
};

// ---- the world around a scan ----

struct GeoPlace {
    double latitude_deg = 0;  ///< -90 to 90, north above 0
    double longitude_deg = 0; ///< -180 to 180, east above 0
};

/// Where up and north are in a scan's coordinates; unit vectors, at right angles.
struct StudyFrame {
    std::array<double, 3> up{0, 0, 1}, north{0, 1, 0};
    std::string note; ///< how north was found: for people, no full stop
};

/// Of a .pro file, a tile set or a scene file. up: what is given, else as scanUp has it. north: what is given (its
/// horizontal part counts); else by the coordinate system that the file, or the first instance with one as it stands,
/// names, whose grid north is turned to true north by the convergence of
/// meridians at the place (UTM and other transverse Mercators, Mercator, Lambert's and Albers' conics, polar
/// stereographic); else what scene files take: +Y, or -Z where Y is up. Throws kBadInput for the file, kBadUsage for a
/// place that is none or lies 30 degrees or more beside the system's central meridian, for vectors that are not finite,
/// 0, or the same direction.
StudyFrame studyFrame(const std::string& path, GeoPlace place, std::optional<std::array<double, 3>> up = {},
                      std::optional<std::array<double, 3>> north = {});

// ---- lights ----

/// Directions that light comes from, endlessly far away, and what each counts.
struct Lights {
    std::vector<double> directions; ///< [N][3], unit length, towards the light
    std::vector<double> weights;    ///< [N]
};

struct CalendarDate {
    int year = 2000;             ///< 1900 to 2100
    unsigned month = 1, day = 1; ///< from 1
};

/// Whole days, from the first one's midnight to the last one's.
struct SunStudy {
    GeoPlace place;
    CalendarDate first, last;
    double every_min = 15;              ///< above 0 and up to 1440
    std::optional<double> utc_offset_h; ///< where days begin; none: utcOffsetOf(place)
};

/// Hours before UTC that the sun is at a longitude, rounded: 15 degrees are one. A day of the sun's lies in one of the
/// calendar's by it, whatever zone the law puts a place in.
double utcOffsetOf(GeoPlace place);

/// The sun in the middle of each stretch of every_min, where its centre is above the level horizon; weights are hours.
/// Its place is that of NOAA's Solar Calculator (Meeus, Astronomical Algorithms, chapter 25, low accuracy: within 0.02
/// degrees from 1900 to 2100), lifted by the air's refraction at sea level (same source).
/// Throws kBadUsage for a place, date or number that is none, days the wrong way round, and more than a million
/// instants.
Lights sunLights(const SunStudy& study, const StudyFrame& frame);

/// The sky: directions of which each stands for the same share of the light that an evenly bright sky sends onto level
/// ground (weights sum to 1). What of it a point sees is the sky view factor of urban climate (Oke 1987): 1 in the
/// open, cos^2 of the horizon's height in a round basin. Always the same directions: a sunflower's seeds on the disc
/// (Vogel 1979), raised to the hemisphere (Malley). count: 1 to 65536.
Lights skyLights(std::size_t count, const StudyFrame& frame);

/// Adds to each point's sum the weights of the lights that shine on it with nothing of the scene in the way.
/// @return rays that were cast
/// Throws kBadInput "point N: ..." for positions that are not finite, kBadUsage for arrays of sizes that do not fit.
std::uint64_t sumLights(const TraceScene& scene, const StudyPoints& points, const Lights& lights,
                        const StudyRules& rules, std::span<double> sums);

// ---- sight ----

struct Observer {
    std::array<double, 3> eye{};                             ///< the scan's coordinates
    double radius = std::numeric_limits<double>::infinity(); ///< what is farther is not seen
};

/// Whether the observer sees each point: 1 or 0 [N]. Lines of sight end at the eye, and nothing there is left out: an
/// eye inside of something sees that alone.
/// @return rays that were cast
/// Throws as sumLights; kBadUsage for an eye that is not finite or a radius that is not above 0.
std::uint64_t testSight(const TraceScene& scene, const StudyPoints& points, const Observer& observer,
                        const StudyRules& rules, std::span<std::uint8_t> visible);

} // namespace pointrt
