// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "format/set/core_splats.h"
#include "runtime/cast/describe_targets.h"
#include "runtime/cast/translated.h"
#include "runtime/studies/target_points.h"

namespace pointrt {

struct ScenePointReader::State {
    TargetList list;
    std::size_t target = 0, splat = 0; ///< the next one
    std::uint64_t found = 0;           ///< points of the target before it
    std::optional<ProFile> file;       ///< the target's

    /// Whether there is a next splat.
    bool findNext() {
        while (target < list.targets.size()) {
            if (!file) file.emplace(openTarget(list, list.targets[target]));
            if (splat < file->info().splat_count) return true;
            requireCount(list, list.targets[target], found);
            file.reset();
            splat = 0;
            found = 0;
            ++target;
        }
        return false;
    }

    /// Points of the target up to most in all.
    void take(std::size_t most, ScenePoints& points) {
        const Target& from = list.targets[target];
        for (; splat < file->info().splat_count && points.radii.size() < most; ++splat) {
            if (from.tile != kNoTile && !isInCore(file->splat(splat))) continue;
            addPoint(*file, splat, from.placement, points);
            points.splat_ids.push_back(static_cast<std::uint32_t>(splat));
            points.instance_ids.push_back(from.instance);
            points.tile_ids.push_back(from.tile);
            ++found;
        }
    }
};

static_assert(kNoTile == kNoHit);

ScenePointReader::ScenePointReader(const std::vector<std::string>& paths)
    : state_(translated([&] {
          return std::make_unique<State>(State{describeTargets(paths), 0, 0, 0, {}});
      })) {}
ScenePointReader::~ScenePointReader() = default;
ScenePointReader::ScenePointReader(ScenePointReader&&) noexcept = default;
ScenePointReader& ScenePointReader::operator=(ScenePointReader&&) noexcept = default;

bool ScenePointReader::next(ScenePoints& points, std::size_t most) {
    return translated([&] {
        points = {};
        while (points.radii.size() < most && state_->findNext()) state_->take(most, points);
        return !points.radii.empty();
    });
}

} // namespace pointrt
