// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/describe_instances.h"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "format/base/error.h"
#include "format/set/open_tile.h"
#include "runtime/device_scene/core_reach.h"
#include "runtime/scene/kept.h"
#include "runtime/scene_io/scene_file.h"

namespace pointrt {
namespace {

/// Margin of a tile's core in position steps: twice the rounding margin of setCoreBox.
constexpr double kBoxSteps = 8;
/// How far the quantised discs of cells may extend beyond the original discs, in radii: a hundredth, plus a margin.
constexpr double kRoundedRadii = 1.0 / 32;

/// The part of the discs' box, grown by margin, that is inside the core.
TileBox common(const TileBox& core, TileBox discs, double margin) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        discs.low[axis] = std::max(core.low[axis], discs.low[axis] - margin);
        discs.high[axis] = std::min(core.high[axis], discs.high[axis] + margin);
    }
    return discs;
}

/// Reads the headers of all original tiles: those without children.
InstanceSet openInstanceSet(const std::string& folder) {
    InstanceSet opened;
    opened.folder = folder;
    opened.set = readTileSet(folder);
    if (opened.set.gaussians)
        throw Error(ExitCode::kBadInput, folder + ": rays cannot be cast at tile sets of Gaussians; bake the capture "
                                                  "into one .pro file, or with --splat disc");
    const std::vector<std::vector<std::uint32_t>> children = childrenOf(opened.set);
    std::vector<bool> original(children.size());
    for (std::uint32_t tile = 0; tile < children.size(); ++tile) original[tile] = children[tile].empty();
    for (std::uint32_t tile = 0; tile < original.size(); ++tile) {
        if (!original[tile]) continue;
        const SetTile& row = opened.set.tiles[tile];
        const double radius = opened.set.levels[row.level].radius_max * cubeOf(opened.set, row).scale;
        opened.tiles.push_back(tile);
        opened.cores.push_back(hitBox(opened.set, original, tile));
        opened.boxes.push_back(
            common(opened.cores.back(), discBoundsOf(opened.set, row, folder), kRoundedRadii * radius));
    }
    return opened;
}

/// The world bounds of a tile's box as placed, with a margin for rounding.
Bounds worldBox(const TileBox& box, const TileCube& cube, const Placement& placement) {
    const double margin = kBoxSteps * static_cast<double>(PRO_POSITION_STEP) * cube.scale;
    pro_info info{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        info.bounds_min[axis] = box.low[axis] - margin;
        info.bounds_max[axis] = box.high[axis] + margin;
    }
    return placedBounds(placement, info);
}

class Describer {
public:
    Describer(const std::vector<ClipDescription>& clips, const std::vector<FilterDescription>& filters) {
        given_.clips = clips;
        given_.filters = filters;
        requireFewHalfSpaces(clips);
    }

    void addPath(const std::string& path) {
        if (!isTileSet(path) && isSceneFile(path))
            addSceneFile(path);
        else
            addInstance({path, {}, {}, {}}, given_);
    }

    InstanceList take() { return std::move(list_); }

private:
    void addSceneFile(const std::string& path) {
        SceneDescription scene = readSceneFile(path);
        scene.clips.insert(scene.clips.end(), given_.clips.begin(), given_.clips.end());
        scene.filters.insert(scene.filters.end(), given_.filters.begin(), given_.filters.end());
        requireFewHalfSpaces(scene.clips);
        for (const InstanceDescription& each : scene.instances) addInstance(each, scene);
        std::copy_if(scene.shapes.begin(), scene.shapes.end(), std::back_inserter(list_.shapes),
                     [](const ShapeDescription& shape) { return shape.visible; });
    }

    /// @param scene with the clips, filters and up direction
    void addInstance(const InstanceDescription& described, const SceneDescription& scene) {
        const std::string& path = described.path;
        const Placement& placement = described.placement;
        InstanceRun run;
        run.kept = keptOf(scene.clips, described);
        run.filters = scene.filters;
        run.up = scene.up;
        run.first = static_cast<std::uint32_t>(list_.instances.size());
        if (isTileSet(path)) {
            run.set = setOf(path);
            addTiles(*run.set, placement);
        } else {
            append(fileOf(path), placement);
        }
        run.count = static_cast<std::uint32_t>(list_.instances.size()) - run.first;
        list_.scene_instances.push_back(run);
    }

    void addTiles(std::uint32_t number, const Placement& placement) {
        const InstanceSet& set = list_.sets[number];
        for (std::size_t i = 0; i < set.tiles.size(); ++i) {
            const SetTile& tile = set.set.tiles[set.tiles[i]];
            const std::uint32_t file = fileOf(tilePath(set.folder, tile));
            list_.files[file].set = number;
            list_.files[file].tile = set.tiles[i];
            list_.files[file].bytes = tile.bytes;
            CastInstance& instance = append(file, placement);
            instance.tile = set.tiles[i];
            instance.core = set.cores[i];
            instance.box = worldBox(set.boxes[i], cubeOf(set.set, tile), placement);
        }
    }

    CastInstance& append(std::uint32_t file, const Placement& placement) {
        list_.files[file].instances.push_back(static_cast<std::uint32_t>(list_.instances.size()));
        CastInstance& instance = list_.instances.emplace_back();
        instance.file = file;
        instance.scene_instance = static_cast<std::uint32_t>(list_.scene_instances.size());
        instance.placement = placement;
        return instance;
    }

    std::uint32_t fileOf(const std::string& path) {
        const auto [found, is_new] = files_.try_emplace(path, static_cast<std::uint32_t>(list_.files.size()));
        if (is_new) list_.files.emplace_back().path = path;
        return found->second;
    }

    std::uint32_t setOf(const std::string& folder) {
        const auto [found, is_new] = sets_.try_emplace(folder, static_cast<std::uint32_t>(list_.sets.size()));
        if (is_new) list_.sets.push_back(openInstanceSet(folder));
        return found->second;
    }

    SceneDescription given_; ///< clips and filters given in addition to those of scene files
    InstanceList list_;
    std::unordered_map<std::string, std::uint32_t> files_, sets_;
};

} // namespace

InstanceList describeInstances(const std::vector<std::string>& paths, const std::vector<ClipDescription>& clips,
                               const std::vector<FilterDescription>& filters) {
    if (paths.empty()) throw Error(ExitCode::kBadUsage, "a scene needs at least one .pro file");
    Describer describer(clips, filters);
    for (const std::string& path : paths) describer.addPath(path);
    return describer.take();
}

} // namespace pointrt
