// SPDX-License-Identifier: Apache-2.0
#include "runtime/session/scan_frame.h"

#include "format/base/error.h"
#include "format/base/require_pro.h"
#include "format/crs/metadata_crs.h"
#include "format/crs/projected_crs.h"
#include "format/set/tile_set.h"
#include "pointrt/pro.hpp"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

ScanFrame frameOfFile(const std::string& path) {
    requirePro(path);
    try {
        const ProFile file(path, PRO_OPEN_SKIP_CHECKSUMS);
        const pro_info& info = file.info();
        const float* up = file.world().up;
        return {{{info.bounds_min[0], info.bounds_min[1], info.bounds_min[2]},
                 {info.bounds_max[0], info.bounds_max[1], info.bounds_max[2]}},
                {double{up[0]}, double{up[1]}, double{up[2]}},
                crsOfMetadata(file.metadata()),
                file.world().metres_per_unit};
    } catch (const ProError& error) {
        throw Error{exitCodeOf(error.result), error.what()};
    }
}

ScanFrame frameOfSet(const std::string& folder) {
    const TileSet set = readTileSet(folder);
    return {
        {vectorOf(set.bounds_min), vectorOf(set.bounds_max)}, {set.up[0], set.up[1], set.up[2]}, set.crs, set.metres};
}

} // namespace

ScanFrame frameOfScan(const std::string& path) { return isTileSet(path) ? frameOfSet(path) : frameOfFile(path); }

std::optional<EarthPlace> earthPlaceOf(const SceneDescription& scene) {
    if (!isProjInstalled()) return std::nullopt;
    for (const InstanceDescription& each : scene.instances) {
        if (each.deleted || each.placement != Placement{}) continue;
        const ScanFrame frame = frameOfScan(each.path);
        if (frame.crs.empty()) continue;
        const Vec3 middle = 0.5 * (frame.bounds.lo + frame.bounds.hi);
        const std::optional<GeographicPlace> place = geographicPlace(frame.crs, middle.x, middle.y);
        if (!place) continue;
        const auto convergence = meridianConvergenceDeg(frame.crs, place->latitude_deg, place->longitude_deg);
        return EarthPlace{place->latitude_deg, place->longitude_deg, convergence.value_or(0)};
    }
    return std::nullopt;
}

} // namespace pointrt
