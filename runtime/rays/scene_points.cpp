// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/scene_points.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "format/base/error.h"
#include "format/pointio/input_order.h"
#include "format/pointio/pro_points.h"
#include "format/pointio/set_points.h"
#include "runtime/cast/describe_instances.h"
#include "runtime/device_scene/render_space.h"
#include "runtime/studies/instance_points.h"

namespace pointrt {
namespace {

constexpr const char* kInstance = "instance_id";

bool isSameColumn(const PointColumn& a, const PointColumn& b) {
    return a.name == b.name && a.type == b.type && a.components == b.components && a.role == b.role;
}

/// Keeps the columns that both outlines have, and extends ranges and bounds to both.
void intersect(PointOutline& outline, const PointOutline& other) {
    std::erase_if(outline.columns, [&](PointColumn& column) {
        const auto found = std::find_if(other.columns.begin(), other.columns.end(),
                                        [&](const PointColumn& each) { return isSameColumn(each, column); });
        if (found == other.columns.end()) return true;
        if (column.range && found->range)
            column.range = {
                {std::min((*column.range)[0], (*found->range)[0]), std::max((*column.range)[1], (*found->range)[1])}};
        return false;
    });
    for (std::size_t axis = 0; axis < 3; ++axis) {
        outline.bounds_min[axis] = std::min(outline.bounds_min[axis], other.bounds_min[axis]);
        outline.bounds_max[axis] = std::max(outline.bounds_max[axis], other.bounds_max[axis]);
    }
    outline.position_step = std::min(outline.position_step, other.position_step);
    outline.count = *outline.count + *other.count;
}

/// Transforms the outline to world coordinates. Points that are moved lose their coordinate system.
void place(const Placement& placement, PointOutline& outline) {
    if (placement == Placement{}) return;
    pro_info info{};
    std::ranges::copy(outline.bounds_min, info.bounds_min);
    std::ranges::copy(outline.bounds_max, info.bounds_max);
    const Bounds box = placedBounds(placement, info);
    outline.bounds_min = {box.lo.x, box.lo.y, box.lo.z};
    outline.bounds_max = {box.hi.x, box.hi.y, box.hi.z};
    outline.position_step *= placement.scale;
    outline.metres_per_unit /= placement.scale;
    outline.metadata.clear();
}

PointOutline outlineOf(const InstanceList& list, const InstanceRun& instance) {
    const CastInstance& first = list.instances[instance.first];
    PointOutline outline;
    if (instance.set) {
        outline = outlineOf(list.sets[*instance.set].set, list.sets[*instance.set].folder);
    } else {
        const ProFile file = openInstance(list, first);
        outline = outlineOf(file);
        outline.count = inputCount(file);
        for (PointColumn& column : outline.columns) column.values = nullptr; // the file is closed on return
    }
    place(first.placement, outline);
    return outline;
}

/// @param scene for messages
PointOutline outlineOf(const InstanceList& list, const std::string& scene) {
    if (list.scene_instances.empty())
        throw Error(ExitCode::kBadInput, scene + ": has no scan, so there are no points to evaluate; give --points");
    PointOutline all = outlineOf(list, list.scene_instances.front());
    for (std::size_t i = 1; i < list.scene_instances.size(); ++i)
        intersect(all, outlineOf(list, list.scene_instances[i]));
    return all;
}

/// Transforms points to the world. Normals and radii are the first two columns.
void place(const Placement& placement, PointBlock& block) {
    if (placement == Placement{}) return;
    const std::span<float> normals = numbersIn<float>(block.columns[0]), radii = numbersIn<float>(block.columns[1]);
    for (std::size_t i = 0; i < block.count(); ++i) {
        double* const at = &block.positions[3 * i];
        float* const normal = &normals[3 * i];
        const Vec3 position = placed(placement, {at[0], at[1], at[2]});
        const Vec3 outwards = turned(placement, {double{normal[0]}, double{normal[1]}, double{normal[2]}});
        std::ranges::copy(std::initializer_list<double>{position.x, position.y, position.z}, at);
        std::ranges::copy(std::initializer_list<float>{static_cast<float>(outwards.x), static_cast<float>(outwards.y),
                                                       static_cast<float>(outwards.z)},
                          normal);
        radii[i] = static_cast<float>(placement.scale * double{radii[i]});
    }
}

template <typename Each>
void append(std::vector<Each>& to, const std::vector<Each>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

/// Which splats of a .pro to read: those of its input in input order, or all in file order.
enum class SplatOrder { kInput, kFile };

std::vector<std::uint32_t> allSplats(const ProFile& file) {
    std::vector<std::uint32_t> splats(file.info().splat_count);
    std::iota(splats.begin(), splats.end(), 0u);
    return splats;
}

class PointsOfScene final : public PointSource {
public:
    PointsOfScene(const std::vector<std::string>& paths, const std::vector<std::string>& replaced, SplatOrder order)
        : order_(order), list_(describeInstances(paths)), outline_(outlineOf(list_, paths.front())) {
        std::vector<std::string> names = replaced;
        if (isNumbered()) names.push_back(kInstance);
        std::erase_if(outline_.columns, [&](const PointColumn& column) { return isReplaced(column, names); });
        if (isNumbered()) outline_.columns.push_back({kInstance, PRO_TYPE_U32});
    }

    const PointOutline& outline() const override { return outline_; }

    bool next(StudyBlock& block) override {
        block = {};
        block.points.columns.resize(outline_.columns.size());
        while (block.points.count() < kPointsAtOnce && findNext()) take(kPointsAtOnce - block.points.count(), block);
        return block.points.count() > 0;
    }

private:
    bool isNumbered() const { return list_.scene_instances.size() > 1; }

    /// Opens the next instance or tile when needed. False if no points are left.
    bool findNext() {
        while (target_ < list_.instances.size()) {
            if (!file_) open(list_.instances[target_]);
            if (done_ < splats_.size()) return true;
            file_.reset();
            ++target_;
        }
        return false;
    }

    void open(const CastInstance& target) {
        file_.emplace(openInstance(list_, target));
        splats_ = target.tile != kNoTile        ? coreNumbers(*file_)
                  : order_ == SplatOrder::kFile ? allSplats(*file_)
                                                : inputOrder(*file_);
        requireCount(list_, target, splats_.size());
        done_ = 0;
    }

    /// Appends the next points of the open file, at most `most` of them.
    void take(std::size_t most, StudyBlock& block) {
        const auto splats =
            std::span<const std::uint32_t>(splats_).subspan(done_, std::min(most, splats_.size() - done_));
        const CastInstance& target = list_.instances[target_];
        gatherPoints(*file_, splats, outline_.columns, part_);
        place(target.placement, part_);
        if (isNumbered()) std::ranges::fill(numbersIn<std::uint32_t>(part_.columns.back()), target.scene_instance);
        takeNoise(splats, block);
        append(block.points.positions, part_.positions);
        for (std::size_t k = 0; k < part_.columns.size(); ++k) append(block.points.columns[k], part_.columns[k]);
        const std::span<const float> normals = numbersIn<float>(part_.columns[0]),
                                     radii = numbersIn<float>(part_.columns[1]);
        block.normals.insert(block.normals.end(), normals.begin(), normals.end());
        block.radii.insert(block.radii.end(), radii.begin(), radii.end());
        done_ += splats.size();
    }

    /// Appends noise, 0 for files without it if another file in the block has some.
    void takeNoise(std::span<const std::uint32_t> splats, StudyBlock& block) {
        const std::span<const std::uint8_t> noise = file_->noise();
        if (noise.empty() && block.noise.empty()) return;
        block.noise.resize(block.radii.size());
        const std::span<const float> radii = numbersIn<float>(part_.columns[1]);
        for (std::size_t i = 0; i < splats.size(); ++i)
            block.noise.push_back(noise.empty() ? 0
                                                : radii[i] * static_cast<float>(noise[splats[i]]) /
                                                      static_cast<float>(PRO_NOISE_STEPS));
    }

    SplatOrder order_;
    InstanceList list_;
    PointOutline outline_;
    std::size_t target_ = 0; ///< index of the instance or tile that is read
    std::optional<ProFile> file_;
    std::vector<std::uint32_t> splats_; ///< of file_
    std::size_t done_ = 0;              ///< of splats_
    PointBlock part_;
};

} // namespace

std::unique_ptr<PointSource> scenePoints(const std::vector<std::string>& paths,
                                         const std::vector<std::string>& replaced) {
    return std::make_unique<PointsOfScene>(paths, replaced, SplatOrder::kInput);
}

std::unique_ptr<PointSource> sceneSplats(const std::vector<std::string>& paths,
                                         const std::vector<std::string>& replaced) {
    return std::make_unique<PointsOfScene>(paths, replaced, SplatOrder::kFile);
}

PointOutline sceneOutline(const std::vector<std::string>& paths) {
    return outlineOf(describeInstances(paths), paths.front());
}

} // namespace pointrt
