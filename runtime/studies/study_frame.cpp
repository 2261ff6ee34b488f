// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pointrt/studies.hpp"
#include "runtime/cast/translated.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/scene/sun.h"
#include "runtime/studies/meridians.h"
#include "runtime/studies/scene_world.h"
#include "runtime/util/parse.h"
#include "runtime/util/vec.h"

namespace pointrt {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// Maps of this kind are no use, and nobody's, so far from their middle: latitude and longitude are swapped, mostly.
constexpr double kFarthestEast = 30;

using Numbers = std::array<double, 3>;

[[noreturn]] void refuse(const std::string& reason) { throw TraceError(TraceError::Kind::kBadUsage, reason); }

Vec3 vectorOf(const Numbers& n) { return {n[0], n[1], n[2]}; }
Numbers numbersOf(Vec3 v) { return {v.x, v.y, v.z}; }

Vec3 unitOf(const Numbers& numbers, const char* name) {
    const Vec3 vector = vectorOf(numbers);
    if (!(std::isfinite(length(vector)) && length(vector) > 0))
        refuse(std::string(name) + " must be a direction: three finite numbers that are not all 0");
    return normalize(vector);
}

void requirePlace(GeoPlace place) {
    if (!(std::abs(place.latitude_deg) <= 90)) refuse("the latitude must be from -90 to 90 degrees");
    if (!(std::abs(place.longitude_deg) <= 180)) refuse("the longitude must be from -180 to 180 degrees");
}

void requireNear(const Meridians& meridians, GeoPlace place) {
    const bool bends = meridians.transverse || meridians.cone != 0;
    const double east = std::abs(degreesEast(place.longitude_deg, meridians.central_deg));
    const bool polar = !meridians.transverse && std::abs(meridians.cone) == 1;
    if (bends && !polar && east >= kFarthestEast)
        refuse("longitude " + plainText(place.longitude_deg) + " is " + plainText(std::round(east)) +
               " degrees from the middle of the scan's coordinate system: places are latitude, then longitude");
}

/// A short name of a system for people.
std::string shortName(const std::string& crs) {
    if (crs.starts_with("EPSG:")) return crs;
    const std::size_t open = crs.find('"'), close = crs.find('"', open + 1);
    return open == crs.npos || close == crs.npos ? "its coordinate system" : crs.substr(open + 1, close - open - 1);
}

/// By the coordinate system, or as scene files take it.
Vec3 defaultNorth(const SceneWorld& world, Vec3 up, GeoPlace place, std::string& note) {
    const auto meridians = meridiansOf(world.crs);
    // within 2.6 degrees: the grid's plane is the ground
    const bool lies_level = dot(up, turned(world.placement, {0, 0, 1})) > 0.999;
    if (meridians && lies_level) {
        requireNear(*meridians, place);
        const double convergence = convergenceDeg(*meridians, place.latitude_deg, place.longitude_deg);
        char degrees[32];
        std::snprintf(degrees, sizeof degrees, "%.2f", convergence);
        note = std::string("grid north is ") + degrees + " degrees clockwise of true north in " + shortName(world.crs);
        return turned(world.placement, {-std::sin(convergence * kDegree), std::cos(convergence * kDegree), 0});
    }
    const Vec3 north = defaultNorth(up);
    note = std::string("north is taken for ") + (north.y > 0.9    ? "+Y"
                                                 : north.z < -0.9 ? "-Z"
                                                                  : "what -Z is on the ground");
    note += world.crs.empty() ? ": the scan names no coordinate system"
                              : ": the meridians of " + shortName(world.crs) + " are not known here";
    return north;
}

} // namespace

StudyFrame studyFrame(const std::string& path, GeoPlace place, std::optional<Numbers> given_up,
                      std::optional<Numbers> given_north) {
    requirePlace(place);
    const SceneWorld world = translated([&] { return sceneWorld(path); });
    StudyFrame frame;
    const Vec3 up = given_up ? unitOf(*given_up, "up") : length(world.up) > 0 ? world.up : Vec3{0, 0, 1};
    frame.note = "north is as given";
    const Vec3 ahead = given_north ? unitOf(*given_north, "north") : defaultNorth(world, up, place, frame.note);
    const Vec3 level = ahead - up * dot(ahead, up);
    if (length(level) < 1e-6) refuse("north must not be along up"); // a direction, but for rounding
    if (!given_up && length(world.up) == 0) frame.note += "; up is taken for +Z: the scan does not say";
    frame.up = numbersOf(up);
    frame.north = numbersOf(normalize(level));
    return frame;
}

} // namespace pointrt
