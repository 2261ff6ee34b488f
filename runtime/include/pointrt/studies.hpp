// SPDX-License-Identifier: Apache-2.0
// Studies of scans: hours of direct sun on points, sky view factors, viewsheds.
//
//   const pointrt::TraceDevice device;
//   const pointrt::TraceScene scene(device, {"roof.pro"});
//   const pointrt::ScanPoints points = pointrt::scanPoints("roof.pro");
//   const pointrt::StudyFrame frame = pointrt::studyFrame("roof.pro", {47.4, 8.5});
//   std::vector<double> hours(points.radii.size());
//   const pointrt::Lights sun = pointrt::sunLights({{47.4, 8.5}, {2026, 6, 21}, {2026, 6, 21}}, frame);
//   pointrt::sumLights(scene, points.rows(), sun, {.sides = points.sides(), .up = frame.up}, hours);
//
// A study point is a disc, or a position in the air. Rays from a disc start a quarter of its radius above it, on the
// side from which they leave. Self-intersections are ignored: hits on discs less than 3 radii above the point's disc
// (or 5 standard deviations of its noise), parallel to it within 60 degrees and crossed in the same direction.
// Secondary rays of pictures follow the same rules (shaders/trace/offset.glsl), except for grazing rays: here the
// self-intersection distance of rays below 2 degrees is that of rays at 2 degrees.
//
// Everything is thread-safe, and throws TraceError or std::bad_alloc.
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

/// The points of a study, a row per point in each array, in the scan's coordinates and unit.
struct StudyPoints {
    std::span<const double> positions;   ///< [N][3]
    std::span<const float> normals = {}; ///< [N][3], any length; empty, or rows of 0: StudyRules::up
    std::span<const float> radii = {};   ///< [N], of the discs; empty: StudyRules::radius
    std::span<const float> noise = {};   ///< [N], standard deviation of the surface; empty: 0
};

/// The splats of a .pro file as points, in its order.
struct ScanPoints {
    std::vector<double> positions;
    std::vector<float> normals, radii, noise; ///< noise is empty if the scan has none
    bool oriented = false;                    ///< true if normals point outward

    StudyPoints rows() const { return {positions, normals, radii, noise}; }
};

/// Reads a .pro file. Throws TraceError "FILE: reason": kBadInput, or kCannotRun if memory is insufficient.
ScanPoints scanPoints(const std::string& path);

/// Points of a scene with their ids, as castRays returns them for hits.
struct ScenePoints : ScanPoints {
    std::vector<std::uint32_t> splat_ids, instance_ids;
    std::vector<std::uint32_t> tile_ids; ///< kNoHit unless the instance is a set
};

/// Reads the points of a scene, given as to TraceScene, block by block in bounded memory: instance by instance, in the
/// world's coordinates; the splats of a .pro in its order; those of a tile set tile by tile, each once, from the cores
/// of its finest tiles. One file is open at a time. Not thread-safe.
class ScenePointReader {
public:
    /// A block size that is traced efficiently.
    static constexpr std::size_t kPoints = std::size_t{1} << 19;

    /// Throws as TraceScene does for its paths.
    explicit ScenePointReader(const std::vector<std::string>& paths);
    ~ScenePointReader();
    ScenePointReader(ScenePointReader&&) noexcept;
    ScenePointReader& operator=(ScenePointReader&&) noexcept;

    /// Replaces points by the next ones, at most `most`; returns false at the end. Does not set oriented; use sidesOf.
    /// Throws kBadInput for an unreadable file.
    bool next(ScenePoints& points, std::size_t most = kPoints);

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The median radius of a scene's splats, from a sample of some ten thousand: a default for points without a radius. 0
/// if there are no splats. Throws as ScenePointReader.
double medianRadius(const std::vector<std::string>& paths);

/// The sides of a point's disc that receive light or are visible.
enum class Sides {
    kFront, ///< only the side of the normal: for oriented normals
    kBoth,  ///< both sides: for leaves, wires, and normals that are not oriented
};

/// kFront if the normals of all files of the scene are oriented, else kBoth. Throws as ScenePointReader.
Sides sidesOf(const std::vector<std::string>& paths);

/// The up direction of a .pro file, a tile set or a scene file, which takes it from its first instance with one unless
/// it has its own. Unit vector; +Z if unknown. Throws as ScenePointReader.
std::array<double, 3> scanUp(const std::string& path);

struct StudyRules {
    Sides sides = Sides::kFront;       ///< for points with a normal; others have both
    std::array<double, 3> up{0, 0, 1}; ///< normal of points without one
    double radius = 0;                 ///< of points without one; 0: their rays start at the position
};

// ---- the world around a scan ----

struct GeoPlace {
    double latitude_deg = 0;  ///< -90 to 90, north positive
    double longitude_deg = 0; ///< -180 to 180, east positive
};

/// Up and north in a scan's coordinates; perpendicular unit vectors.
struct StudyFrame {
    std::array<double, 3> up{0, 0, 1}, north{0, 1, 0};
    std::string note; ///< how north was found, for messages, without a full stop
};

/// The frame of a .pro file, a tile set or a scene file. up: as given, else as scanUp. north: as given (its horizontal
/// part); else from the coordinate system of the file, or of the first instance with one, with grid north corrected to
/// true north by the meridian convergence at place, which PROJ computes for any projected system; else the default of
/// scene files: +Y, or -Z if Y is up. Throws kBadInput for the file, kBadUsage for an invalid place, a place more than
/// 6 degrees outside the system's area of use, and for vectors that are not finite, zero or parallel, and kCannotRun if
/// PROJ (libproj.so.25, opened at run time) is needed and not installed.
StudyFrame studyFrame(const std::string& path, GeoPlace place, std::optional<std::array<double, 3>> up = {},
                      std::optional<std::array<double, 3>> north = {});

// ---- lights ----

/// Directional lights at infinity, with weights.
struct Lights {
    std::vector<double> directions; ///< [N][3], unit length, towards the light
    std::vector<double> weights;    ///< [N]
};

struct CalendarDate {
    int year = 2000;             ///< 1900 to 2100
    unsigned month = 1, day = 1; ///< from 1
};

/// A period of complete days, first and last included.
struct SunStudy {
    GeoPlace place;
    CalendarDate first, last;
    double every_min = 15;              ///< above 0 and up to 1440
    std::optional<double> utc_offset_h; ///< time zone in which days begin; none: utcOffsetOf(place)
};

/// The solar time zone of a place, in hours ahead of UTC: longitude / 15 degrees, rounded. With it, the daylight of a
/// day falls on one calendar date, whatever the legal time zone.
double utcOffsetOf(GeoPlace place);

/// The sun's position at the middle of each interval of every_min minutes in which its centre is above the horizon;
/// weights are hours. Positions follow NOAA's Solar Calculator (Meeus, Astronomical Algorithms, chapter 25, low
/// accuracy: within 0.02 degrees from 1900 to 2100), with atmospheric refraction at sea level (same source). Throws
/// kBadUsage for invalid places, dates and numbers, last before first, and more than a million instants.
Lights sunLights(const SunStudy& study, const StudyFrame& frame);

/// The sky as cosine-weighted directions: each carries the same share of the light of a uniform sky on level ground
/// (weights sum to 1). The sum at a point is the sky view factor (Oke 1987): 1 in the open, cos^2 of the horizon's
/// elevation in a round basin. The directions are deterministic: a sunflower pattern on the disc (Vogel 1979),
/// projected to the hemisphere (Malley's method). count: 1 to 65536.
Lights skyLights(std::size_t count, const StudyFrame& frame);

/// Adds to each point's sum the weights of the lights that reach it unoccluded.
/// @return the number of rays cast
/// Throws kBadInput "point N: ..." for positions that are not finite, kBadUsage for arrays of inconsistent sizes.
std::uint64_t sumLights(const TraceScene& scene, const StudyPoints& points, const Lights& lights,
                        const StudyRules& rules, std::span<double> sums);

// ---- sight ----

struct Observer {
    std::array<double, 3> eye{};                             ///< in the scan's coordinates
    double radius = std::numeric_limits<double>::infinity(); ///< range of sight
};

/// Tests whether the observer sees each point: 1 or 0 [N]. Surfaces around the eye are not ignored: an eye inside an
/// object sees only that object.
/// @return the number of rays cast
/// Throws as sumLights, and kBadUsage for an eye that is not finite or a radius that is not above 0.
std::uint64_t testSight(const TraceScene& scene, const StudyPoints& points, const Observer& observer,
                        const StudyRules& rules, std::span<std::uint8_t> visible);

} // namespace pointrt
