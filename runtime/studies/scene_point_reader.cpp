// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "format/set/core_splats.h"
#include "runtime/cast/describe_instances.h"
#include "runtime/cast/translated.h"
#include "runtime/studies/instance_points.h"

namespace pointrt {

struct ScenePointReader::State {
    InstanceList list;
    std::size_t instance = 0, splat = 0; ///< index of the next splat, and of its instance
    std::uint64_t found = 0;             ///< points of the instance so far
    std::optional<ProFile> file;         ///< of the instance

    /// Opens the next instance when needed. False if no splats are left.
    bool findNext() {
        while (instance < list.instances.size()) {
            if (!file) file.emplace(openInstance(list, list.instances[instance]));
            if (splat < file->info().splat_count) return true;
            requireCount(list, list.instances[instance], found);
            file.reset();
            splat = 0;
            found = 0;
            ++instance;
        }
        return false;
    }

    /// Appends points of the instance until points has `most`.
    void take(std::size_t most, ScenePoints& points) {
        const CastInstance& from = list.instances[instance];
        for (; splat < file->info().splat_count && points.radii.size() < most; ++splat) {
            if (from.tile != kNoTile && !isInCore(file->splat(splat))) continue;
            addPoint(*file, splat, from.placement, points);
            points.splat_ids.push_back(static_cast<std::uint32_t>(splat));
            points.instance_ids.push_back(from.scene_instance);
            points.tile_ids.push_back(from.tile);
            ++found;
        }
    }
};

static_assert(kNoTile == kNoHit);

ScenePointReader::ScenePointReader(const std::vector<std::string>& paths)
    : state_(translated([&] {
          return std::make_unique<State>(State{describeInstances(paths), 0, 0, 0, {}});
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
