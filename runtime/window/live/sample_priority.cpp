// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/sample_priority.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "format/base/parallel.h"

namespace pointrt {
namespace {

// Priorities in frames of age, for empty pixels; for interpolated points, and empty pixels with only sky around; and
// for points near an error of a full step from black to white. While the camera moves, view-dependent points age this
// much faster.
constexpr float kEmptyPriority = 1500, kInterpolatedPriority = 150, kErrorPriority = 3000, kViewDependentAging = 8;
/// Gain at the attention point, and its radius as a fraction of the picture's height.
constexpr float kFocusGain = 2, kFocusRadius = 0.2f;
/// Share of an error that remains a frame later, and that neighbouring tiles get.
constexpr float kErrorDecay = 0.85f, kErrorSpread = 0.5f;
/// Smaller differences, in steps of 255, are not errors but rounding and noise of soft light.
constexpr std::uint32_t kNoiseFloor = 3;

/// The priority of a point with this info.
float priorityOf(std::uint32_t info, const SelectionParams& params) {
    const auto age = static_cast<float>((params.frame - info) & kPointFrameMask);
    const bool view_dependent = params.camera_moves && (info & kPointViewDependent) != 0;
    return age * (view_dependent ? kViewDependentAging : 1.0f) +
           ((info & kPointInterpolated) != 0 ? kInterpolatedPriority : 0.0f);
}

/// The priority added to each pixel of a tile, and a factor for the sum.
struct TilePriority {
    float added = 0, factor = 1;
};

TilePriority tilePriority(const ErrorMap& errors, const SelectionParams& params, PixelSize size, std::uint32_t tile_x,
                          std::uint32_t tile_y, std::uint32_t across) {
    const float x = (static_cast<float>(tile_x) + 0.5f) * TILE_SIDE - params.focus.x;
    const float y = (static_cast<float>(tile_y) + 0.5f) * TILE_SIDE - params.focus.y;
    const float radius = kFocusRadius * static_cast<float>(size.height);
    return {kErrorPriority / 255 * errors.at(tile_y * across + tile_x),
            1 + kFocusGain / (1 + (x * x + y * y) / (radius * radius))};
}

/// Thresholds in (0, 1], evenly distributed over the picture and, for each pixel, over the frames: the R2 and golden
/// ratio sequences (Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018), in units of 2^-32.
float threshold(std::uint32_t x, std::uint32_t y, std::uint32_t frame) {
    const std::uint32_t at = x * 0xC13FA9A9u + y * 0x91E10DA6u + frame * 0x9E3779B9u;
    return (static_cast<float>(at >> 8) + 1) * 0x1p-24f;
}

/// Each frame considers one row of pixels in four, which takes a quarter of the time.
constexpr std::uint32_t kRowPhases = 4;

/// Priorities of the considered pixels in a row of tiles, tile by tile.
using RowPriorities = std::vector<float>;

class PixelSelector {
public:
    PixelSelector(const RenderCache& cache, const ErrorMap& errors, const SelectionParams& params)
        : cache_(cache), errors_(errors), params_(params), size_(cache.size()), across_(cache.tilesAcross()) {}

    RowPriorities computeRow(std::uint32_t tile_row) const {
        RowPriorities row;
        row.reserve(std::size_t{size_.width} * TILE_SIDE / kRowPhases);
        for (std::uint32_t tile = 0; tile < across_; ++tile) {
            const float of_empty = isSky(tile, tile_row) ? kInterpolatedPriority : kEmptyPriority;
            const TilePriority of_tile = tilePriority(errors_, params_, size_, tile, tile_row, across_);
            visitTile(tile, tile_row, [&](std::uint32_t x, std::uint32_t y) {
                const PixelKey key = cache_.keys()[y * size_.width + x];
                const float own =
                    key == kEmptyPixel ? of_empty : priorityOf(cache_.points().info[pointOf(key)], params_);
                row.push_back((own + of_tile.added) * of_tile.factor);
            });
        }
        return row;
    }

    /// probability: of a pixel of priority 1.
    std::vector<std::uint32_t> select(std::uint32_t tile_row, const RowPriorities& row, float probability) const {
        std::vector<std::uint32_t> selected;
        auto priority = row.begin();
        for (std::uint32_t tile = 0; tile < across_; ++tile)
            visitTile(tile, tile_row, [&](std::uint32_t x, std::uint32_t y) {
                if (*priority++ * probability >= threshold(x, y, params_.frame))
                    selected.push_back(y * size_.width + x);
            });
        return selected;
    }

private:
    /// Whether this tile and its neighbours have points, and only points of the sky.
    bool isSky(std::uint32_t tile_x, std::uint32_t tile_y) const {
        return !cache_.anyTileAround(tile_x, tile_y, [&](std::uint32_t tile) {
            const TileColorSum& sum = cache_.tileColors()[tile];
            return sum.count == 0 || sum.surfaces > 0;
        });
    }

    template <typename Visit>
    void visitTile(std::uint32_t tile, std::uint32_t tile_row, Visit visit) const {
        const std::uint32_t end_x = std::min((tile + 1) * TILE_SIDE, size_.width);
        const std::uint32_t end_y = std::min((tile_row + 1) * TILE_SIDE, size_.height);
        // consecutive phases never consider adjacent rows
        const std::uint32_t phase = params_.frame * 2 % kRowPhases + params_.frame / 2 % 2;
        for (std::uint32_t y = tile_row * TILE_SIDE + phase; y < end_y; y += kRowPhases)
            for (std::uint32_t x = tile * TILE_SIDE; x < end_x; ++x) visit(x, y);
    }

    const RenderCache& cache_;
    const ErrorMap& errors_;
    const SelectionParams& params_;
    PixelSize size_;
    std::uint32_t across_;
};

/// The probability per priority that selects count pixels on average; pixels that reach 1 are selected once.
float probabilityFor(const std::vector<RowPriorities>& rows, std::uint32_t count) {
    constexpr int kTries = 3; // each iteration finds more pixels that reach 1
    float probability = 0;
    for (int i = 0; i < kTries; ++i) {
        const float limit = probability > 0 ? 1 / probability : std::numeric_limits<float>::max();
        std::vector<double> sums(rows.size());
        std::vector<std::size_t> certain(rows.size());
        forAll(rows.size(), [&](std::size_t row) {
            for (float priority : rows[row]) {
                sums[row] += priority < limit ? priority : 0.0f;
                certain[row] += priority < limit ? 0 : 1;
            }
        });
        const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
        const double left = count - double{1} * std::accumulate(certain.begin(), certain.end(), std::size_t{0});
        if (!(sum > 0) || !(left > 0)) break;
        probability = static_cast<float>(left / sum);
    }
    return probability;
}

} // namespace

ErrorMap::ErrorMap(PixelSize size)
    : across_((size.width + TILE_SIDE - 1) / TILE_SIDE), down_((size.height + TILE_SIDE - 1) / TILE_SIDE) {
    errors_.resize(std::size_t{across_} * down_);
    recorded_.resize(errors_.size());
}

void ErrorMap::record(std::uint32_t x, std::uint32_t y, std::uint32_t steps) {
    if (steps <= kNoiseFloor) return;
    float& recorded = recorded_[y / TILE_SIDE * across_ + x / TILE_SIDE];
    recorded = std::max(recorded, static_cast<float>(steps));
}

void ErrorMap::advanceFrame() {
    for (std::uint32_t y = 0; y < down_; ++y)
        for (std::uint32_t x = 0; x < across_; ++x) {
            const std::size_t at = y * across_ + x;
            float adjacent = 0;
            if (x > 0) adjacent = std::max(adjacent, recorded_[at - 1]);
            if (x + 1 < across_) adjacent = std::max(adjacent, recorded_[at + 1]);
            if (y > 0) adjacent = std::max(adjacent, recorded_[at - across_]);
            if (y + 1 < down_) adjacent = std::max(adjacent, recorded_[at + across_]);
            errors_[at] = std::max({kErrorDecay * errors_[at], recorded_[at], kErrorSpread * adjacent});
            if (errors_[at] < kNoiseFloor) errors_[at] = 0;
        }
    std::fill(recorded_.begin(), recorded_.end(), 0.0f);
}

void ErrorMap::clear() {
    std::fill(errors_.begin(), errors_.end(), 0.0f);
    std::fill(recorded_.begin(), recorded_.end(), 0.0f);
}

std::vector<std::uint32_t> selectPixels(const RenderCache& cache, const ErrorMap& errors,
                                        const SelectionParams& params) {
    const PixelSelector selector(cache, errors, params);
    const std::uint32_t down = cache.tilesDown();
    std::vector<RowPriorities> rows(down);
    std::vector<std::vector<std::uint32_t>> selected(down);
    forAll(down, [&](std::size_t row) { rows[row] = selector.computeRow(static_cast<std::uint32_t>(row)); });
    const float probability = probabilityFor(rows, params.count);
    forAll(down, [&](std::size_t row) {
        selected[row] = selector.select(static_cast<std::uint32_t>(row), rows[row], probability);
    });
    std::vector<std::uint32_t> all;
    for (const std::vector<std::uint32_t>& row : selected) all.insert(all.end(), row.begin(), row.end());
    return all;
}

} // namespace pointrt
