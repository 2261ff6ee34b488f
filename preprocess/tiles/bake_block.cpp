// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/bake_block.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "format/base/error.h"
#include "preprocess/surface/check.h"
#include "preprocess/surface/estimate.h"
#include "preprocess/surface/neighbors.h"
#include "preprocess/tiles/buckets.h"
#include "preprocess/tiles/gaussian_tiles.h"
#include "preprocess/tiles/halo.h"
#include "preprocess/tiles/select_splats.h"
#include "preprocess/tiles/splat_file.h"

namespace pointrt {

namespace {

/// Limit of a halo's points, in points of the plan's largest tile: with very uneven density, a wider halo would make
/// one tile take as long as a block.
constexpr std::uint64_t kMostTiles = 8;

std::uint64_t mostHaloPoints(const SetPlan& plan) {
    std::uint64_t largest = 0;
    for (const PlanTile& tile : plan.tiles) largest = std::max(largest, tile.points);
    return std::min(kMostTiles * largest, mostPointsAtOnce(plan.bake.max_memory));
}

/// The points read of a tile and its halo.
struct TilePoints {
    PointBudget::Reservation reservation;
    BoxPoints box;
    std::size_t lacking = 0; ///< TileCounts::lacking
};

/// Reads a tile's points with a halo as wide as they need.
TilePoints readWithHalo(const SetPlan& plan, std::uint32_t number, PointBudget& budget) {
    const PlanTile& tile = plan.tiles[number];
    const auto neighbors = static_cast<std::size_t>(plan.bake.surface.neighbors);
    const std::uint64_t most = mostHaloPoints(plan);
    double width = firstHalo(plan, tile);
    std::uint64_t count = countPoints(plan, number, width, most);
    while (true) {
        TilePoints points{budget.reserve(count), readPoints(plan, number, width)};
        const Cloud& cloud = points.box.cloud;
        points.lacking = countLacking(cloud.positions, points.box.core, haloOf(plan, tile, width), neighbors);
        if (points.lacking == 0) return points;
        count = countPoints(plan, number, 2 * width, most);
        if (count > most) return points;
        width *= 2;
    }
}

bool isSurface(const std::vector<Vec3f>& positions) {
    try {
        surface::requireSurface(positions);
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// Assigns each normal of the plan's oriented sample to the nearest point.
std::vector<Vec3f> sidesOf(const BoxPoints& points) {
    if (points.side_positions.empty()) return {};
    std::vector<Vec3f> sides(points.cloud.positions.size(), Vec3f::Zero());
    const surface::NearestSearch search(points.cloud.positions);
    for (std::size_t s = 0; s < points.side_positions.size(); ++s) {
        std::uint32_t nearest = 0;
        float squared = 0;
        if (search.nearest(points.side_positions[s], {&nearest, 1}, {&squared, 1}) == 1)
            sides[nearest] = points.side_normals[s];
    }
    return sides;
}

/// One shape for all tiles: tiles must not decide for themselves.
SplatShape splatShapeOf(const SetPlan& plan) {
    const SurfaceOptions& surface = plan.bake.surface;
    if (surface.splat != SplatShape::kAuto) return surface.splat;
    const bool has_normals = plan.schema.normals && surface.normals != NormalSource::kEstimate;
    if (has_normals || !plan.statistics.scattered) return SplatShape::kDisc;
    return plan.statistics.volume ? SplatShape::kBall : SplatShape::kAuto;
}

SurfaceDecisions decisionsOf(const SetPlan& plan, BoxPoints& points, SurfaceOptions& options) {
    options.orient = plan.orient;
    SurfaceDecisions decided{sidesOf(points), plan.statistics, std::exchange(points.silhouettes, {}), {}};
    if (options.orient != OrientMode::kMst || decided.sides.empty()) return decided;
    options.orient = OrientMode::kAuto; // uses the plan's sides if nothing else decides
    points.cloud.normal_sides = false;
    points.cloud.sensor_of_point.clear();
    return decided;
}

/// 1 for splats of the core's points and those that fill gaps in the core.
std::vector<std::uint8_t> flagOwn(const Splats& splats, const std::vector<std::uint8_t>& core,
                                  const std::vector<PositionCode>& codes) {
    std::vector<std::uint8_t> own(codes.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
        const std::uint32_t point = splats.input_index[i];
        own[i] = point < splats.input_count ? core[point] : static_cast<std::uint8_t>(isInCore(codes[i]));
    }
    return own;
}

/// Moves splats back to the core's border if cleaning moved them to a place without a tile, where no ray would hit
/// them, or into a tile of a coarser level, whose merged tiles would not find them in its file. If this leaves the core
/// empty, all of them are moved back, because there would be no tile otherwise.
void keepInTiles(const TileTree& tree, const TileKey& tile, const std::vector<std::uint8_t>& own,
                 std::vector<PositionCode>& codes) {
    bool holds_one = false;
    for (std::size_t i = 0; i < codes.size(); ++i) holds_one |= own[i] && isInCore(codes[i]);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        if (!own[i] || isInCore(codes[i])) continue;
        const auto there = tree.originalAt(tile, codes[i]);
        if (holds_one && there && there->level <= tile.level) continue;
        for (std::int32_t& each : codes[i]) each = std::clamp(each, 0, kCoreSteps - 1);
    }
}

/// No splats, with the schema of all tiles.
TileSplats noSplats(const Cloud& cloud) {
    TileSplats none;
    for (const Attribute& each : cloud.attributes)
        none.attributes.push_back({each.name, each.type, each.components, {}});
    return none;
}

} // namespace

TileSet latticeOf(const SetPlan& plan) {
    TileSet set;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        set.lattice_origin[a] = plan.lattice_origin[axis];
        set.up[a] = plan.world.up[axis];
    }
    set.edge = plan.edge;
    set.metres = plan.world.metres_per_unit;
    set.crs = plan.world.crs;
    set.input_points = plan.points_read;
    set.settings = plan.settings;
    set.oriented = plan.orient != OrientMode::kNone;
    set.gaussians = holdsGaussians(plan);
    for (const PlanScan& scan : plan.scans) {
        const Vec3d place = scan.sensor.value_or(Vec3d::Zero());
        set.sensors.push_back({place.x(), place.y(), place.z(), scan.sensor ? 1.0 : 0.0});
    }
    const bool known = std::any_of(plan.scans.begin(), plan.scans.end(), [](auto& scan) { return !!scan.sensor; });
    if (!known) set.sensors.clear();
    return set;
}

TileTree treeOf(const SetPlan& plan) {
    std::vector<TileKey> originals;
    for (const PlanTile& tile : plan.tiles) originals.push_back(keyOf(tile));
    return TileTree(originals);
}

TileSplats bakeTile(const SetPlan& plan, const TileTree& tree, std::uint32_t number, PointBudget& budget,
                    TileCounts& counts) {
    const PlanTile& tile = plan.tiles.at(number);
    if (holdsGaussians(plan)) {
        counts.points += tile.points;
        counts.splats += tile.points;
        return gaussiansOfTile(plan, number);
    }
    TilePoints read = readWithHalo(plan, number, budget);
    BoxPoints& points = read.box;
    counts.points += tile.points;
    counts.lacking += read.lacking;
    if (!isSurface(points.cloud.positions)) return noSplats(points.cloud);
    const std::vector<Attribute> attributes = std::exchange(points.cloud.attributes, {});
    SurfaceOptions options = plan.bake.surface;
    options.splat = splatShapeOf(plan);
    const SurfaceDecisions decided = decisionsOf(plan, points, options);
    SurfaceReport report;
    const Splats splats = estimateSplats(std::move(points.cloud), options, report, {}, decided);
    std::vector<PositionCode> codes = codesOf(latticeOf(plan), keyOf(tile), splats);
    const std::vector<std::uint8_t> own = flagOwn(splats, points.core, codes);
    keepInTiles(tree, keyOf(tile), own, codes);
    for (std::size_t i = 0; i < own.size(); ++i) counts.filled += own[i] && splats.input_index[i] >= splats.input_count;
    TileSplats taken = selectSplats(splats, attributes, codes, own, edgeOf(plan, tile.level));
    counts.outliers += report.outliers_removed;
    counts.splats += taken.positions.size();
    for (const std::uint32_t word : taken.normals) counts.balls += (word & kBallNormal) != 0;
    return taken;
}

TileCounts bakeBlocks(const SetPlan& plan, BlockRange blocks, std::size_t threads, const StageProgress& progress) {
    const TileTree tree = treeOf(plan);
    const std::string folder = splatsFolder(plan);
    makeFolder(folder);
    const TileRange range = tilesOf(plan, blocks);
    std::vector<TileCounts> counts(range.end - range.first);
    PointBudget budget(mostPointsAtOnce(plan.bake.max_memory));
    forTiles(counts.size(), threads, "tiles", progress, [&](std::size_t k) {
        const auto number = static_cast<std::uint32_t>(range.first + k);
        const TileKey key = keyOf(plan.tiles[number]);
        if (!hasSplatFile(folder, key)) writeSplats(folder, key, bakeTile(plan, tree, number, budget, counts[k]));
    });
    return std::accumulate(counts.begin(), counts.end(), TileCounts{});
}

} // namespace pointrt
