// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/listed_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "format/base/error.h"
#include "runtime/rays/ray_source.h"

namespace pointrt {
namespace {

const RowKind kPointRows{"point",
                         "points",
                         {3, 6},
                         "3: a position, or 6: a position and a normal",
                         "(N, 3): positions, or (N, 6): positions and normals",
                         {"x", "y", "z", "nx", "ny", "nz"}};

class ListedPoints final : public PointSource {
public:
    ListedPoints(const std::string& file, const PointOutline& scene) {
        const std::unique_ptr<RaySource> rows = openRays(file, kPointRows);
        RayBlock block;
        while (rows->next(block)) take(*rows, block);
        describe(scene);
    }

    const PointOutline& outline() const override { return outline_; }

    bool next(StudyBlock& block) override {
        const std::size_t count = std::min(kPointsAtOnce, positions_.size() / 3 - done_);
        const auto part = [&](const auto& numbers) {
            const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(3 * done_);
            return std::pair(first, first + static_cast<std::ptrdiff_t>(3 * count));
        };
        const auto [first, last] = part(positions_);
        block = {};
        block.points.positions.assign(first, last);
        if (!normals_.empty()) {
            const auto [from, to] = part(normals_);
            block.normals.assign(from, to);
            const auto bytes = std::as_bytes(std::span(block.normals));
            block.points.columns.emplace_back(bytes.begin(), bytes.end());
        }
        done_ += count;
        return count > 0;
    }

private:
    void take(const RaySource& rows, const RayBlock& block) {
        const std::size_t width = rows.width();
        const auto add = [&](const auto& numbers) {
            for (std::size_t at = 0; at < numbers.size(); at += width) {
                for (std::size_t k = 0; k < width; ++k)
                    if (!std::isfinite(numbers[at + k]))
                        throw Error(ExitCode::kBadInput, rows.placeOf(block, at / width) + ": not finite");
                for (std::size_t k = 0; k < 3; ++k) positions_.push_back(static_cast<double>(numbers[at + k]));
                for (std::size_t k = 3; k < width; ++k) normals_.push_back(static_cast<float>(numbers[at + k]));
            }
        };
        add(block.doubles);
        add(block.floats);
    }

    void describe(const PointOutline& scene) {
        outline_.metadata = scene.metadata;
        outline_.metres_per_unit = scene.metres_per_unit;
        outline_.position_step = scene.position_step;
        outline_.count = positions_.size() / 3;
        if (!normals_.empty()) outline_.columns = {{"normals", PRO_TYPE_F32, 3, PointRole::kNormal}};
        outline_.bounds_min = outline_.bounds_max = scene.bounds_min;
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            double& low = outline_.bounds_min[i % 3];
            double& high = outline_.bounds_max[i % 3];
            low = i < 3 ? positions_[i] : std::min(low, positions_[i]);
            high = i < 3 ? positions_[i] : std::max(high, positions_[i]);
        }
    }

    std::vector<double> positions_;
    std::vector<float> normals_;
    PointOutline outline_;
    std::size_t done_ = 0;
};

} // namespace

std::unique_ptr<PointSource> listedPoints(const std::string& file, const PointOutline& scene) {
    return std::make_unique<ListedPoints>(file, scene);
}

} // namespace pointrt
