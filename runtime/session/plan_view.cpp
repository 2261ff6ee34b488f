// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/plan_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "format/base/error.h"
#include "format/base/require_pro.h"
#include "format/crs/epsg_code.h"
#include "format/crs/metadata_crs.h"
#include "format/set/tile_set.h"
#include "pointrt/pro.hpp"
#include "runtime/scene/background.h"
#include "runtime/scene_io/scene_file.h"
#include "runtime/util/parse.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

/// What a plan needs to know of a scan.
struct PlanScan {
    Vec3 low, high; ///< of its splats
    Vec3 up;        ///< 0 if unknown
    std::string crs;
    double metres_per_unit = 0; ///< 0: unknown, or degrees
};

[[noreturn]] void refusePlan(const std::string& reason) { throw Error{ExitCode::kBadUsage, "--plan: " + reason}; }

PlanScan planOfFile(const std::string& path) {
    requirePro(path);
    try {
        const ProFile file(path, PRO_OPEN_SKIP_CHECKSUMS);
        const pro_info& info = file.info();
        const float* up = file.world().up;
        return {{info.bounds_min[0], info.bounds_min[1], info.bounds_min[2]},
                {info.bounds_max[0], info.bounds_max[1], info.bounds_max[2]},
                {double{up[0]}, double{up[1]}, double{up[2]}},
                crsOfMetadata(file.metadata()),
                file.world().metres_per_unit};
    } catch (const ProError& error) {
        throw Error{exitCodeOf(error.result), error.what()};
    }
}

PlanScan planOfSet(const std::string& folder) {
    const TileSet set = readTileSet(folder);
    return {vectorOf(set.bounds_min), vectorOf(set.bounds_max), {set.up[0], set.up[1], set.up[2]}, set.crs, set.metres};
}

PlanScan planScan(const std::string& path) {
    if (isTileSet(path)) return planOfSet(path);
    if (isSceneFile(path)) refusePlan("needs a scan or a tile set, not a scene file");
    return planOfFile(path);
}

/// The pixels of an axis: from a multiple of their size, over all of [low, high], or count of them around the middle.
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

void fillPlan(Options& options) {
    if (options.plan == 0) return;
    constexpr double kLevel = 0.999; // cos(2.6 degrees): the grid's plane is the ground
    const PlanScan scan = planScan(options.scene);
    if (scan.up != Vec3{} && normalize(scan.up).z < kLevel) refusePlan("the scan's z axis is not up");
    const double pixel = options.plan;
    const Vec3 middle = options.camera.target.value_or(0.5 * (scan.low + scan.high));
    PixelRange columns = pixelsOver(scan.low.x, scan.high.x, pixel), rows = pixelsOver(scan.low.y, scan.high.y, pixel);
    if (const auto size = options.choices.size) {
        columns = pixelsAround(middle.x, size->width, pixel);
        rows = pixelsAround(middle.y, size->height, pixel);
    }
    if (!(columns.count <= kMaxPixelSide && rows.count <= kMaxPixelSide))
        refusePlan("the scan has " + plainText(columns.count) + " x " + plainText(rows.count) +
                   " pixels of this size, at most " + std::to_string(kMaxPixelSide) +
                   " on a side are possible: choose larger ones, or a part with --size and --target");
    options.choices.size = PixelSize{static_cast<std::uint32_t>(columns.count), static_cast<std::uint32_t>(rows.count)};
    if (!options.choices.background) options.choices.background = Background{.transparent = true};
    const double x = pixel * (columns.first + columns.count / 2), y = pixel * (rows.first + rows.count / 2);
    const double height = pixel * rows.count;
    options.camera.eye = Vec3{x, y, scan.high.z + std::max(height, scan.high.z - scan.low.z)};
    options.camera.target = Vec3{x, y, scan.low.z};
    options.camera.up = Vec3{0, 1, 0}; // north; the scene's own up is
    options.up_axis = Vec3{0, 0, 1};
    options.camera.ortho = true;
    options.camera.ortho_height = height;
    options.place = GeoReference{pixel, pixel * columns.first, pixel * (rows.first + rows.count),
                                 scan.metres_per_unit > 0 ? epsgCode(scan.crs) : 0};
}

} // namespace pointrt
