// SPDX-License-Identifier: Apache-2.0
// Measuring scans: distances, angles and areas between points, fitted circles and spheres, volumes over a base plane,
// profiles of surfaces, and distances between two surfaces.
//
//   const std::vector<pointrt::Position> legs{{0, 0, 0}, {3, 4, 12}};
//   const pointrt::PathMeasures gap = pointrt::measurePath(legs, {0, 0, 1});
//   gap.last_leg, gap.horizontal, gap.height; // 13, 5, 12
//   const pointrt::Volume heap = pointrt::measureVolume(scene, rim, {.up = pointrt::scanUp("heap.pro")});
//   heap.cut, heap.fill;
//
// All lengths are in the unit of the coordinates, areas and volumes in its square and cube. Positions are doubles, so
// coordinates of national grids keep their precision. Everything is thread-safe, and throws TraceError or
// std::bad_alloc.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pointrt/studies.hpp"

namespace pointrt {

/// x y z in the coordinates of the scene.
using Position = std::array<double, 3>;

// ---- of points ----

/// Measures of a polyline. The last leg is the one between its last two points.
struct PathMeasures {
    double length = 0;            ///< of all legs
    double horizontal_length = 0; ///< of all legs, across up
    double last_leg = 0;
    Position difference{};           ///< along the last leg
    double horizontal = 0;           ///< of the last leg, across up
    double height = 0;               ///< of the last leg, along up; negative if it goes down
    double slope_deg = 0;            ///< of the last leg, from horizontal: -90 to 90
    std::optional<double> angle_deg; ///< between the last two legs, 0 to 180; 180 if they are in line
    /// The area of the polygon that the points enclose, for three points or more. If the polygon is not flat, its
    /// vector area: the area of its projection onto the plane where that is largest.
    std::optional<double> area;
    std::optional<double> plan_area; ///< of the polygon seen along up
    std::optional<double> perimeter; ///< of the polygon
};

/// @param points at least two
/// @param up unit length
/// Coordinates that are not finite give NaN. Throws kBadUsage for fewer points.
PathMeasures measurePath(std::span<const Position> points, const Position& up);

/// Least-squares fits. rms is the root mean square distance of the points from the fitted shape.
struct FittedPlane {
    Position center{}; ///< the points' centroid
    Position normal{}; ///< unit length; of the two signs, the one whose largest component is positive
    double rms = 0;
};
struct FittedCircle {
    Position center{}, normal{}; ///< of its plane, which is fitted first
    double radius = 0, rms = 0;  ///< rms includes the distances from the plane
};
struct FittedSphere {
    Position center{};
    double radius = 0, rms = 0;
};

/// Each needs at least three points, a sphere four. Throws kBadUsage for fewer, for points that lie on a line (plane
/// and circle) or in a plane (sphere), and for coordinates that are not finite.
FittedPlane fitPlane(std::span<const Position> points);
FittedCircle fitCircle(std::span<const Position> points);
FittedSphere fitSphere(std::span<const Position> points);

// ---- of surfaces ----

/// The nearest point of the scene's surface to each point: rays in all directions find the surface, then further rays
/// follow its normals to the foot of the perpendicular. A detail that appears smaller than 10 degrees from the point
/// may be missed. NaN for a point from which no ray hits a surface. Throws kBadUsage for coordinates that are not
/// finite.
std::vector<Position> snapToSurface(const TraceScene& scene, std::span<const Position> points);

/// Moves each point vertically to the surface visible from above: the first hit of a ray cast against up, a unit
/// vector. NaN if the ray misses. Throws kBadUsage for coordinates that are not finite.
std::vector<Position> dropToSurface(const TraceScene& scene, std::span<const Position> points, const Position& up);

struct VolumeRules {
    Position up{0, 0, 1}; ///< unit length
    /// Height of the base along up; none: the plane fitted to the rim.
    std::optional<double> base_height = {};
    /// Side of the cells of the raster; 0: a thousandth of the rim's longer side.
    double cell = 0;
};

struct Volume {
    double cut = 0;     ///< between the base and surfaces above it
    double fill = 0;    ///< between the base and surfaces below it
    double area = 0;    ///< of the rim, seen along up
    double covered = 0; ///< the part of area where rays hit a surface; the rest counts neither as cut nor as fill
    double cell = 0;    ///< side of the cells
    std::uint64_t rays = 0;
    FittedPlane base; ///< level if base_height is given
    double net() const { return cut - fill; }
};

/// The volume within a rim. A vertical ray through each cell of a raster starts above all surfaces; its first hit
/// counts. Cells that the rim cuts count in part. Throws kBadUsage for a rim of fewer than three points or without
/// area, a base that is vertical, more than 2^28 cells, and numbers that are not finite.
Volume measureVolume(const TraceScene& scene, std::span<const Position> rim, const VolumeRules& rules);

enum class ProfileSide {
    kAbove, ///< rays go down
    kBelow, ///< rays go up
};

struct ProfileRules {
    Position up{0, 0, 1}; ///< unit length
    double step = 0;      ///< horizontal distance between stations along the line; 0: a thousandth of its length
    ProfileSide from = ProfileSide::kAbove;
    std::optional<double> start_height = {}; ///< position along up where rays start; none: outside the scene
    bool all = false;                        ///< true: all surfaces along the rays; false: the first
    double apart = 0; ///< with all: surfaces less than this apart count as one; unit of the scene, at least 0
    double width = 0; ///< of a band along the line: a station is the median across it; 0: one ray per station
};

/// A point of a profile.
struct ProfilePoint {
    double station = 0;      ///< horizontal distance along the line
    std::uint32_t layer = 0; ///< number of the surface along the ray, from 0 at its start
    bool hit = false;        ///< false: no surface there, and position is on the line
    Position position{};
    double height = 0;        ///< position along up
    double low = 0, high = 0; ///< lowest and highest of all rays across the band; without a band, equal to height
};

/// The surface along a polyline, found by vertical rays. Stations are at multiples of step and at the end of the line,
/// in order. all and width cannot be combined. Throws kBadUsage for a line of fewer than two points or without length,
/// more than 2^22 stations, negative lengths, and numbers that are not finite.
std::vector<ProfilePoint> surfaceProfile(const TraceScene& scene, std::span<const Position> line,
                                         const ProfileRules& rules);

struct ContourRules {
    Position up{0, 0, 1}; ///< unit length
    double interval = 0;  ///< height difference between lines; 0: a round number that gives 10 to 25 heights
    double cell = 0;      ///< side of the cells of the raster, one ray each; 0: a thousandth of the scene's longer side
    double shortest = 0;  ///< length of the shortest line to keep; at least 0
};

/// A line of equal height. Higher ground lies on its left, seen from above.
struct Contour {
    double height = 0;     ///< height along up: a multiple of the interval
    bool is_index = false; ///< every fifth height, a multiple of five intervals: to label
    bool closed = false;   ///< the last point is followed by the first
    std::vector<Position> points;
};

/// Contour lines of the surface seen from above, linear between the first hits of a raster of vertical rays; from the
/// lowest height to the highest. They end where there is no surface. Throws kBadUsage for more than 2^26 cells or
/// 10,000 heights, negative lengths, and numbers that are not finite.
std::vector<Contour> surfaceContours(const TraceScene& scene, const ContourRules& rules);

/// A plane that cuts a scene, with the axes of a drawing of the cut.
struct SectionPlane {
    Position point{};                     ///< in the plane: the drawing's origin
    Position right{1, 0, 0}, up{0, 1, 0}; ///< in the plane, perpendicular, unit length
};

/// A plane in the notation of pointrt-view --section: "z=1.2", "x=3", "-x=3" (seen from the other side),
/// "X0,Y0,X1,Y1". The drawing's axes are those of pointrt-view's picture. Throws kBadUsage for any other text, and for
/// a thickness.
/// @param up of the scene, unit length
SectionPlane sectionPlane(const std::string& text, const Position& up);
/// The plane perpendicular to up, a unit vector, at a height along it; drawn with north up.
SectionPlane levelPlane(double height, const Position& up);

struct SectionRules {
    /// Distance between the rays that sweep the plane; above 0. Surfaces closer together than two steps become one.
    double step = 0;
    double gap = 0;       ///< widest gap to join lines across; gaps up to 2.5 steps are always closed
    double tolerance = 0; ///< largest distance by which simplified lines may deviate from the points that rays hit
    double shortest = 0;  ///< length of the shortest line to keep
};

/// A line in which a plane cuts surfaces.
struct SectionLine {
    bool closed = false; ///< the last point is followed by the first
    std::vector<Position> points;
};

/// The lines in which a plane cuts all of the scene's surfaces, as in a floor plan. Rays sweep the plane along both
/// axes and from both ends, through every surface; hits count if the angle between ray and normal is less than 55
/// degrees. Hits are linked into lines perpendicular to their normals; lines whose extensions meet get a corner there.
/// Surfaces within 12 degrees of parallel to the plane have no line. Throws kBadUsage for more than 2^22 rays, lengths
/// that are negative, a step of 0, and numbers that are not finite.
std::vector<SectionLine> sectionLines(const TraceScene& scene, const SectionPlane& plane, const SectionRules& rules);

/// Distances of points from the scene's surface along their normals, on the nearer side, up to most: positive if the
/// point lies on the side of the surface that its normal points to, as in M3C2 (Lague, Brodu and Leroux 2013). NaN if
/// there is no surface.
/// @param points with normals; with radii, rays start 2% of the radius behind the point to hit what coincides with it
/// @param most above 0
/// @return the number of rays cast
/// Throws kBadUsage for arrays of inconsistent sizes and points without normals, kBadInput "point N: ..." for positions
/// that are not finite.
std::uint64_t surfaceDistances(const TraceScene& scene, const StudyPoints& points, double most,
                               std::span<double> distances);

/// Statistics of signed distances; NaN distances only count as missing.
struct DistanceStatistics {
    std::uint64_t count = 0, missing = 0;
    double mean = 0, deviation = 0; ///< standard deviation
    double median = 0;
    double rms = 0;
    double percentile_95 = 0; ///< 95th percentile of absolute distances
    double low = 0, high = 0;
};

/// All numbers are NaN if no distance is finite. Percentiles are nearest ranks. Overwrites distances.
DistanceStatistics distanceStatistics(std::span<double> distances);

} // namespace pointrt
