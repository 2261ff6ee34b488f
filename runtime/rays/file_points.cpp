// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/file_points.h"

#include <cmath>
#include <utility>

#include "format/base/error.h"

namespace pointrt {
namespace {

class FilePoints final : public PointSource {
public:
    FilePoints(const std::string& file, std::unique_ptr<PointReader> reader, const PointOutline& scene,
               const std::vector<std::string>& replaced)
        : file_(file), reader_(std::move(reader)), outline_(reader_->outline()) {
        for (std::size_t k = 0; k < outline_.columns.size(); ++k)
            if (!isReplaced(outline_.columns[k], replaced)) kept_.push_back(k);
        std::erase_if(outline_.columns, [&](const PointColumn& column) { return isReplaced(column, replaced); });
        if (outline_.metadata.empty()) {
            outline_.metadata = scene.metadata;
            outline_.metres_per_unit = scene.metres_per_unit;
        }
        if (outline_.position_step == 0) outline_.position_step = scene.position_step;
    }

    const PointOutline& outline() const override { return outline_; }

    bool next(StudyBlock& block) override {
        block = {};
        if (!reader_->next(read_, kPointsAtOnce)) return false;
        requireFinite();
        block.points.positions = std::move(read_.positions);
        for (const std::size_t k : kept_) block.points.columns.push_back(std::move(read_.columns[k]));
        for (std::size_t k = 0; k < kept_.size(); ++k) {
            const auto take = [&](std::vector<float>& into) {
                const std::span<const float> numbers = numbersIn<float>(block.points.columns[k]);
                into.assign(numbers.begin(), numbers.end());
            };
            if (outline_.columns[k].role == PointRole::kNormal) take(block.normals);
            if (outline_.columns[k].role == PointRole::kRadius) take(block.radii);
        }
        done_ += block.points.count();
        return true;
    }

private:
    void requireFinite() const {
        for (std::size_t i = 0; i < read_.positions.size(); ++i)
            if (!std::isfinite(read_.positions[i]))
                throw Error(ExitCode::kBadInput,
                            file_ + ": point " + std::to_string(done_ + i / 3) + ": the position is not finite");
    }

    std::string file_;
    std::unique_ptr<PointReader> reader_;
    PointOutline outline_;
    std::vector<std::size_t> kept_; ///< columns of the reader
    PointBlock read_;
    std::uint64_t done_ = 0;
};

} // namespace

std::unique_ptr<PointSource> filePoints(const std::string& file, std::unique_ptr<PointReader> reader,
                                        const PointOutline& scene, const std::vector<std::string>& replaced) {
    return std::make_unique<FilePoints>(file, std::move(reader), scene, replaced);
}

} // namespace pointrt
