// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/plan_view.h"

#include <algorithm>
#include <cmath>

#include "format/base/error.h"
#include "format/crs/epsg_code.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/scene/background.h"
#include "runtime/scene/upright.h"
#include "runtime/session/scan_frame.h"
#include "runtime/util/parse.h"

namespace pointrt {
namespace {

[[noreturn]] void refusePlan(const std::string& reason) { throw Error{ExitCode::kBadUsage, "--plan: " + reason}; }

/// The properties of a scene that a plan needs.
struct PlanScene {
    std::optional<Bounds> bounds; ///< bounds of the visible scans; nullopt if no scan is visible
    std::optional<Vec3> up;       ///< up of the first scan that stores it
    int epsg = 0; ///< coordinate system of all scans, if they are at the place that their files state; 0: unknown
};

Vec3 corner(const ScanFrame& scan, unsigned bits) {
    const auto& [low, high] = scan.bounds;
    return {bits & 1 ? high.x : low.x, bits & 2 ? high.y : low.y, bits & 4 ? high.z : low.z};
}

void addScan(const ScanFrame& scan, const Placement& placement, PlanScene& scene) {
    const bool is_first = !scene.bounds;
    for (unsigned bits = 0; bits < 8; ++bits) {
        const Vec3 at = placed(placement, corner(scan, bits));
        scene.bounds = joined(scene.bounds.value_or(Bounds{at, at}), {at, at});
    }
    if (!scene.up && scan.up != Vec3{}) scene.up = normalize(turned(placement, scan.up));
    const bool is_on_the_map = placement == Placement{} && scan.metres_per_unit > 0;
    const int epsg = is_on_the_map ? epsgCode(scan.crs) : 0;
    scene.epsg = is_first || scene.epsg == epsg ? epsg : 0;
}

PlanScene planScene(const SceneDescription& description) {
    PlanScene scene;
    for (const InstanceDescription& each : description.instances)
        if (each.visible) addScan(frameOfScan(each.path), each.placement, scene);
    if (!scene.bounds) refusePlan(description.path + " has no visible scan");
    return scene;
}

/// The axes of the map: east, north and up, orthonormal. East is along x, or along y if x is vertical.
struct MapAxes {
    Vec3 east, north, up;
};

MapAxes mapAxes(Vec3 up) {
    constexpr double kLevel = 0.999; // cos(2.6 degrees): so the grid's plane is the ground
    const std::optional<Vec3> axis = nearestAxis(up);
    if (!axis || dot(up, *axis) < kLevel) refusePlan("up is not along a coordinate axis of the scan, as a plan needs");
    const Vec3 east = axis->x != 0 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    return {east, cross(*axis, east), *axis};
}

/// The lowest and the highest coordinate along an axis, which may point backwards.
struct PlanExtent {
    double low = 0, high = 0;
};

PlanExtent extentAlong(const Bounds& bounds, Vec3 axis) {
    const double from = dot(bounds.lo, axis), to = dot(bounds.hi, axis);
    return {std::min(from, to), std::max(from, to)};
}

/// The pixels along an axis: from a multiple of their size, covering [low, high], or `count` of them around the middle.
struct PixelRange {
    double first = 0; ///< in pixels from 0
    double count = 0;
};

PixelRange pixelsOver(double low, double high, double pixel) {
    const double first = std::floor(low / pixel);
    return {first, std::max(1.0, std::ceil(high / pixel) - first)};
}

PixelRange pixelsAround(double middle, double count, double pixel) {
    return {std::round(middle / pixel - count / 2), count};
}

} // namespace

void fillPlan(Options& options, SceneDescription& description) {
    if (options.plan == 0) return;
    const PlanScene scene = planScene(description);
    const MapAxes axes = mapAxes(description.up.value_or(scene.up.value_or(Vec3{0, 0, 1})));
    const Bounds& bounds = *scene.bounds;
    const PlanExtent across = extentAlong(bounds, axes.east), along = extentAlong(bounds, axes.north);
    const PlanExtent heights = extentAlong(bounds, axes.up);
    const double pixel = options.plan;
    const Vec3 middle = options.camera.target.value_or(0.5 * (bounds.lo + bounds.hi));
    PixelRange columns = pixelsOver(across.low, across.high, pixel), rows = pixelsOver(along.low, along.high, pixel);
    if (const auto size = options.choices.size) {
        columns = pixelsAround(dot(middle, axes.east), size->width, pixel);
        rows = pixelsAround(dot(middle, axes.north), size->height, pixel);
    }
    if (!(columns.count <= kMaxPixelSide && rows.count <= kMaxPixelSide))
        refusePlan("the plan has " + plainText(columns.count) + " x " + plainText(rows.count) +
                   " pixels, but at most " + std::to_string(kMaxPixelSide) +
                   " per side are possible: choose larger pixels, or a part with --size and --target");
    options.choices.size = PixelSize{static_cast<std::uint32_t>(columns.count), static_cast<std::uint32_t>(rows.count)};
    if (!options.choices.background) options.choices.background = Background{.transparent = true};
    const Vec3 centre =
        pixel * (columns.first + columns.count / 2) * axes.east + pixel * (rows.first + rows.count / 2) * axes.north;
    const double height = pixel * rows.count;
    options.camera.eye = centre + (heights.high + std::max(height, heights.high - heights.low)) * axes.up;
    options.camera.target = centre + heights.low * axes.up;
    options.camera.up = axes.north; // the picture's up, which differs from the scene's
    options.up_axis = axes.up;
    if (!description.up) description.up = axes.up;
    options.camera.ortho = true;
    options.camera.ortho_height = height;
    options.place =
        GeoReference{pixel, pixel * columns.first, pixel * (rows.first + rows.count), axes.up.z > 0 ? scene.epsg : 0};
}

} // namespace pointrt
