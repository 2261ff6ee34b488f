// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/study/scene_points.h"

#include <algorithm>
#include <utility>

#include "format/base/error.h"
#include "format/points/input_order.h"
#include "format/points/pro_points.h"

namespace pointrt {
namespace {

constexpr const char* kInstance = "instance_id";

bool isAlike(const PointColumn& a, const PointColumn& b) {
    return a.name == b.name && a.type == b.type && a.components == b.components && a.role == b.role;
}

/// Leaves of one what both have, with room for the values of both.
void share(PointOutline& outline, const PointOutline& other) {
    std::erase_if(outline.columns, [&](PointColumn& column) {
        const auto found = std::find_if(other.columns.begin(), other.columns.end(),
                                        [&](const PointColumn& each) { return isAlike(each, column); });
        if (found == other.columns.end()) return true;
        if (column.range && found->range)
            column.range = {
                {std::min((*column.range)[0], (*found->range)[0]), std::max((*column.range)[1], (*found->range)[1])}};
        column.values = nullptr;
        return false;
    });
    for (std::size_t axis = 0; axis < 3; ++axis) {
        outline.bounds_min[axis] = std::min(outline.bounds_min[axis], other.bounds_min[axis]);
        outline.bounds_max[axis] = std::max(outline.bounds_max[axis], other.bounds_max[axis]);
    }
    outline.position_step = std::min(outline.position_step, other.position_step);
}

/// A file's splats, with what it says of their noise.
struct PointFileOfScene {
    ProFile file;
    std::vector<std::uint32_t> splats;
};

class ScenePoints final : public PointSource {
public:
    ScenePoints(const std::vector<std::string>& paths, const std::vector<std::string>& left_out) {
        for (const std::string& path : paths) {
            ProFile file(path, PRO_OPEN_SKIP_CHECKSUMS);
            std::vector<std::uint32_t> splats = inputOrder(file);
            files_.push_back({std::move(file), std::move(splats)});
        }
        describe(left_out);
    }

    const PointOutline& outline() const override { return outline_; }

    bool next(StudyBlock& block) override {
        while (place_ < files_.size() && done_ == files_[place_].splats.size()) {
            ++place_;
            done_ = 0;
        }
        if (place_ == files_.size()) return false;
        const PointFileOfScene& from = files_[place_];
        const std::size_t count = std::min(kPointsAtOnce, from.splats.size() - done_);
        const std::span<const std::uint32_t> splats = std::span(from.splats).subspan(done_, count);
        gatherPoints(from.file, splats, outline_.columns, block.points);
        takeRows(from.file, splats, block);
        done_ += count;
        return true;
    }

private:
    void describe(const std::vector<std::string>& left_out) {
        outline_ = outlineOf(files_[0].file);
        std::uint64_t count = 0;
        for (const PointFileOfScene& each : files_) {
            share(outline_, outlineOf(each.file));
            count += each.splats.size();
        }
        outline_.count = count;
        const auto is = [](const PointColumn& column, const std::string& name) {
            return column.role == PointRole::kAttribute && column.name == name;
        };
        std::erase_if(outline_.columns, [&](const PointColumn& column) {
            return (files_.size() > 1 && is(column, kInstance)) ||
                   std::any_of(left_out.begin(), left_out.end(), [&](const auto& name) { return is(column, name); });
        });
        if (files_.size() > 1) outline_.columns.push_back({kInstance, PRO_TYPE_U32});
    }

    /// Normals and radii as the study takes them, which stand first among the columns, noise, and the file's number.
    void takeRows(const ProFile& file, std::span<const std::uint32_t> splats, StudyBlock& block) {
        const std::span<const float> normals = numbersIn<float>(block.points.columns[0]);
        const std::span<const float> radii = numbersIn<float>(block.points.columns[1]);
        block.normals.assign(normals.begin(), normals.end());
        block.radii.assign(radii.begin(), radii.end());
        block.noise.clear();
        if (const std::span<const std::uint8_t> noise = file.noise(); !noise.empty())
            for (std::size_t i = 0; i < splats.size(); ++i)
                block.noise.push_back(block.radii[i] * static_cast<float>(noise[splats[i]]) /
                                      static_cast<float>(PRO_NOISE_STEPS));
        if (files_.size() > 1)
            std::ranges::fill(numbersIn<std::uint32_t>(block.points.columns.back()),
                              static_cast<std::uint32_t>(place_));
    }

    std::vector<PointFileOfScene> files_;
    PointOutline outline_;
    std::size_t place_ = 0, done_ = 0;
};

} // namespace

std::unique_ptr<PointSource> scenePoints(const std::vector<std::string>& paths,
                                         const std::vector<std::string>& left_out) {
    try {
        return std::make_unique<ScenePoints>(paths, left_out);
    } catch (const ProError& error) {
        throw Error(ExitCode::kBadInput, error.what());
    }
}

} // namespace pointrt
