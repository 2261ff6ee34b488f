// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/plan_check.h"

#include <algorithm>
#include <cmath>

namespace pointrt {
namespace {

constexpr std::uint32_t kMostLevels = 32; // cells of the finest level have 31 bits
constexpr std::uint32_t kMostComponents = 4;

bool isScalar(Scalar type) { return type >= Scalar::kI8 && type <= Scalar::kF64; }

bool isGood(const PlanAttribute& attribute) {
    return !attribute.name.empty() && isScalar(attribute.type) && isScalar(attribute.read_type) &&
           attribute.components >= 1 && attribute.components <= kMostComponents;
}

bool isGood(const PlanSchema& schema) {
    const std::size_t bytes = schema.scan_bytes;
    return (bytes <= 2 || bytes == 4) && std::all_of(schema.attributes.begin(), schema.attributes.end(),
                                                     [](const PlanAttribute& each) { return isGood(each); });
}

bool isGood(const PlanTile& tile, const SetPlan& plan) {
    return tile.level < plan.levels && std::all_of(tile.cell.begin(), tile.cell.end(), [](int i) { return i >= 0; }) &&
           tile.points >= 1 && std::isfinite(tile.spacing) && tile.spacing >= 0;
}

bool isGood(const NoData& no_data) { return no_data.axis >= 0 && no_data.axis < 3 && std::isfinite(no_data.limit); }

bool areBlocks(const std::vector<std::uint32_t>& first_tiles, std::size_t tiles) {
    return !first_tiles.empty() && first_tiles.front() == 0 && first_tiles.back() == tiles &&
           std::is_sorted(first_tiles.begin(), first_tiles.end());
}

} // namespace

std::string findPlanFault(const SetPlan& plan) {
    if (!(plan.edge > 0) || !std::isfinite(plan.edge) || !plan.lattice_origin.allFinite()) return "invalid lattice";
    if (plan.levels < 1 || plan.levels > kMostLevels) return "invalid number of levels";
    if (plan.orient < OrientMode::kAuto || plan.orient > OrientMode::kNone) return "invalid orientation mode";
    if (!isGood(plan.schema)) return "invalid schema of points";
    for (const PlanTile& tile : plan.tiles)
        if (!isGood(tile, plan)) return "tile " + std::to_string(&tile - plan.tiles.data()) + " is invalid";
    for (const PlanScan& scan : plan.scans)
        if (!std::all_of(scan.no_data.begin(), scan.no_data.end(), [](const NoData& each) { return isGood(each); }))
            return "invalid no_data of a scan";
    if (!areBlocks(plan.first_tile_of_block, plan.tiles.size())) return "blocks do not match the tiles";
    const CloudStatistics& statistics = plan.statistics;
    if (!statistics.noise.empty() && statistics.noise.size() != plan.scans.size())
        return "noise does not match the scans";
    if (statistics.common_reach && !(*statistics.common_reach >= 0)) return "invalid common_reach";
    if (statistics.thinning && !(statistics.thinning->finest_cells >= 0)) return "invalid finest_cells";
    if (statistics.radius_limit && !(*statistics.radius_limit > 0)) return "invalid radius_limit";
    return "";
}

} // namespace pointrt
