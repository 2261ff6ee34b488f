// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "format/base/error.h"
#include "format/crs/projected_crs.h"
#include "pointrt/studies.hpp"
#include "runtime/cast/translated.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/scene/sun.h"
#include "runtime/studies/scene_world.h"
#include "runtime/studies/study_values.h"
#include "runtime/util/degree.h"
#include "runtime/util/parse.h"
#include "runtime/util/vec.h"

namespace pointrt {
namespace {

using Numbers = std::array<double, 3>;

Vec3 unitOf(const Numbers& numbers, const char* name) {
    const Vec3 vector = vectorOf(numbers);
    if (!(std::isfinite(length(vector)) && length(vector) > 0))
        refuseUsage(std::string(name) + " must be a direction: three finite numbers that are not all 0");
    return normalize(vector);
}

void requireOnEarth(GeoPlace place) {
    if (!(std::abs(place.latitude_deg) <= 90)) refuseUsage("the latitude must be from -90 to 90 degrees");
    if (!(std::abs(place.longitude_deg) <= 180)) refuseUsage("the longitude must be from -180 to 180 degrees");
}

/// Whether a place lies within the area, or outside it by at most the width of a UTM zone.
bool isNear(const AreaOfUse& area, GeoPlace place) {
    constexpr double kMarginDeg = 6;
    const auto eastOf = [](double longitude, double origin) { // 0 to 360 degrees
        const double east = std::fmod(longitude - origin, 360.0);
        return east < 0 ? east + 360 : east;
    };
    const double width = area.east_deg - area.west_deg + (area.east_deg < area.west_deg ? 360 : 0);
    return place.latitude_deg >= area.south_deg - kMarginDeg && place.latitude_deg <= area.north_deg + kMarginDeg &&
           (width + 2 * kMarginDeg >= 360 ||
            eastOf(place.longitude_deg, area.west_deg - kMarginDeg) <= width + 2 * kMarginDeg);
}

/// The usual reason is that latitude and longitude are swapped.
[[noreturn]] void refusePlace(GeoPlace place, const ProjectedCrs& crs) {
    refuseUsage(plainText(place.latitude_deg) + "," + plainText(place.longitude_deg) + " is outside the area of " +
                crs.name + ": give latitude, then longitude, of the scan");
}

/// True north in the scan's coordinates: x east and y north on the grid.
Vec3 trueNorth(const std::string& crs_text, const ProjectedCrs& crs, GeoPlace place, std::string& note) {
    if (crs.area_of_use && !isNear(*crs.area_of_use, place)) refusePlace(place, crs);
    const auto convergence_deg = meridianConvergenceDeg(crs_text, place.latitude_deg, place.longitude_deg);
    if (!convergence_deg) refusePlace(place, crs);
    char degrees[32];
    std::snprintf(degrees, sizeof degrees, "%.2f", *convergence_deg);
    note = std::string("grid north is ") + degrees + " degrees clockwise of true north in " + crs.name;
    return {-std::sin(*convergence_deg * kDegree), std::cos(*convergence_deg * kDegree), 0};
}

/// A name for messages: the EPSG code, or the name in WKT.
std::string shortName(const std::string& crs) {
    if (crs.starts_with("EPSG:")) return crs;
    const std::size_t open = crs.find('"'), close = crs.find('"', open + 1);
    return open == crs.npos || close == crs.npos ? "its coordinate system" : crs.substr(open + 1, close - open - 1);
}

/// North if there is no usable coordinate system, as in scene files.
Vec3 assumedNorth(Vec3 up, const std::string& reason, std::string& note) {
    const Vec3 north = defaultNorth(up);
    note = std::string("north is assumed to be ") + (north.y > 0.9    ? "+Y"
                                                     : north.z < -0.9 ? "-Z"
                                                                      : "-Z projected onto the ground");
    note += ": " + reason;
    return north;
}

Vec3 northOf(const SceneWorld& world, Vec3 up, GeoPlace place, std::string& note) {
    if (world.crs.empty()) return assumedNorth(up, "the scan names no coordinate system", note);
    constexpr double kLevel = 0.999; // cos(2.6 degrees): the grid's plane is the ground
    if (dot(up, turned(world.placement, {0, 0, 1})) < kLevel)
        return assumedNorth(up, "up is not the z axis of the scan's coordinate system", note);
    try {
        const auto crs = projectedCrs(world.crs);
        if (!crs) return assumedNorth(up, shortName(world.crs) + " is not a projected coordinate system", note);
        return turned(world.placement, trueNorth(world.crs, *crs, place, note));
    } catch (const Error& error) { // without PROJ
        throw TraceError(TraceError::Kind::kCannotRun, std::string(error.what()) + ", or give north");
    }
}

} // namespace

StudyFrame studyFrame(const std::string& path, GeoPlace place, std::optional<Numbers> given_up,
                      std::optional<Numbers> given_north) {
    requireOnEarth(place);
    const SceneWorld world = translated([&] { return sceneWorld(path); });
    StudyFrame frame;
    const Vec3 up = given_up ? unitOf(*given_up, "up") : length(world.up) > 0 ? world.up : Vec3{0, 0, 1};
    frame.note = "north is as given";
    const Vec3 ahead = given_north ? unitOf(*given_north, "north") : northOf(world, up, place, frame.note);
    const Vec3 level = ahead - up * dot(ahead, up);
    if (length(level) < 1e-6) refuseUsage("north must not be along up"); // only rounding errors are left
    if (!given_up && length(world.up) == 0) frame.note += "; up is assumed to be +Z: the scan does not say";
    frame.up = arrayOf(up);
    frame.north = arrayOf(normalize(level));
    return frame;
}

} // namespace pointrt
