// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/urgency.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "format/base/parallel.h"

namespace pointrt {
namespace {

// In frames of age: what is seen for the first time, what was guessed, what was found wrong around by a full step from
// black to white. Of mirrors, while the camera moves, each frame of age counts for so many.
constexpr float kHole = 1500, kGuess = 150, kWrong = 3000, kMirrorFrames = 8;
/// Where the eye rests all counts so much more, within this part of the picture's height.
constexpr float kFocusGain = 2, kFocusRadius = 0.2f;
/// Of what was wrong, what is still believed a frame later, and of the tiles beside.
constexpr float kKept = 0.85f, kSpread = 0.5f;
/// Steps of 255 that are no error: rounding, and the noise of soft light.
constexpr std::uint32_t kTolerated = 3;

/// Of what a point is.
float urgencyOf(std::uint32_t info, const Attention& attention) {
    const auto age = static_cast<float>((attention.frame - info) & kCarriedFrames);
    const bool turns = attention.moves && (info & kCarriedView) != 0;
    return age * (turns ? kMirrorFrames : 1.0f) + ((info & kCarriedGuess) != 0 ? kGuess : 0.0f);
}

/// Of a tile: what each of its pixels has on top, and what all of that is multiplied by.
struct TileUrgency {
    float added = 0, factor = 1;
};

TileUrgency tileUrgency(const ErrorMap& errors, const Attention& attention, PixelSize size, std::uint32_t tile_x,
                        std::uint32_t tile_y, std::uint32_t across) {
    const float x = (static_cast<float>(tile_x) + 0.5f) * TILE_SIDE - attention.focus.x;
    const float y = (static_cast<float>(tile_y) + 0.5f) * TILE_SIDE - attention.focus.y;
    const float radius = kFocusRadius * static_cast<float>(size.height);
    return {kWrong / 255 * errors.at(tile_y * across + tile_x),
            1 + kFocusGain / (1 + (x * x + y * y) / (radius * radius))};
}

/// Thresholds in (0, 1] that lie evenly over the picture and, frame by frame, over each pixel's time: R2's and the
/// golden ratio's sequences (Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018), in units of
/// 2^-32.
float threshold(std::uint32_t x, std::uint32_t y, std::uint32_t frame) {
    const std::uint32_t at = x * 0xC13FA9A9u + y * 0x91E10DA6u + frame * 0x9E3779B9u;
    return (static_cast<float>(at >> 8) + 1) * 0x1p-24f;
}

/// A picture's rows take turns: each frame looks at one of so many, which takes as much less time.
constexpr std::uint32_t kTurns = 4;

/// The urgency of the pixels of a row of tiles whose turn it is, tile by tile.
using RowUrgency = std::vector<float>;

class Chooser {
public:
    Chooser(const CarriedPicture& picture, const ErrorMap& errors, const Attention& attention)
        : picture_(picture), errors_(errors), attention_(attention), size_(picture.size()),
          across_(picture.tilesAcross()) {}

    RowUrgency look(std::uint32_t tile_row) const {
        RowUrgency row;
        row.reserve(std::size_t{size_.width} * TILE_SIDE / kTurns);
        for (std::uint32_t tile = 0; tile < across_; ++tile) {
            const TileUrgency of_tile = tileUrgency(errors_, attention_, size_, tile, tile_row, across_);
            visitTile(tile, tile_row, [&](std::uint32_t x, std::uint32_t y) {
                const PixelKey key = picture_.keys()[y * size_.width + x];
                const float own = key == kNoPoint ? kHole : urgencyOf(picture_.points().info[pointIn(key)], attention_);
                row.push_back((own + of_tile.added) * of_tile.factor);
            });
        }
        return row;
    }

    /// chance: of a pixel of urgency 1.
    std::vector<std::uint32_t> choose(std::uint32_t tile_row, const RowUrgency& row, float chance) const {
        std::vector<std::uint32_t> chosen;
        auto urgency = row.begin();
        for (std::uint32_t tile = 0; tile < across_; ++tile)
            visitTile(tile, tile_row, [&](std::uint32_t x, std::uint32_t y) {
                if (*urgency++ * chance >= threshold(x, y, attention_.frame)) chosen.push_back(y * size_.width + x);
            });
        return chosen;
    }

private:
    template <typename Visit>
    void visitTile(std::uint32_t tile, std::uint32_t tile_row, Visit visit) const {
        const std::uint32_t end_x = std::min((tile + 1) * TILE_SIDE, size_.width);
        const std::uint32_t end_y = std::min((tile_row + 1) * TILE_SIDE, size_.height);
        // the sequence's next turn is never beside the last one's row
        const std::uint32_t turn = attention_.frame * 2 % kTurns + attention_.frame / 2 % 2;
        for (std::uint32_t y = tile_row * TILE_SIDE + turn; y < end_y; y += kTurns)
            for (std::uint32_t x = tile * TILE_SIDE; x < end_x; ++x) visit(x, y);
    }

    const CarriedPicture& picture_;
    const ErrorMap& errors_;
    const Attention& attention_;
    PixelSize size_;
    std::uint32_t across_;
};

/// With which so many pixels are chosen: what is urgent enough is chosen for certain, and no more than once.
float chanceFor(const std::vector<RowUrgency>& rows, std::uint32_t wanted) {
    constexpr int kTries = 3; // each finds some more that are certain
    float chance = 0;
    for (int i = 0; i < kTries; ++i) {
        const float limit = chance > 0 ? 1 / chance : std::numeric_limits<float>::max();
        std::vector<double> sums(rows.size());
        std::vector<std::size_t> certain(rows.size());
        forAll(rows.size(), [&](std::size_t row) {
            for (float urgency : rows[row]) {
                sums[row] += urgency < limit ? urgency : 0.0f;
                certain[row] += urgency < limit ? 0 : 1;
            }
        });
        const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
        const double left = wanted - double{1} * std::accumulate(certain.begin(), certain.end(), std::size_t{0});
        if (!(sum > 0) || !(left > 0)) break;
        chance = static_cast<float>(left / sum);
    }
    return chance;
}

} // namespace

ErrorMap::ErrorMap(PixelSize size)
    : across_((size.width + TILE_SIDE - 1) / TILE_SIDE), down_((size.height + TILE_SIDE - 1) / TILE_SIDE) {
    errors_.resize(std::size_t{across_} * down_);
    noted_.resize(errors_.size());
}

void ErrorMap::note(std::uint32_t x, std::uint32_t y, std::uint32_t steps) {
    if (steps <= kTolerated) return;
    float& noted = noted_[y / TILE_SIDE * across_ + x / TILE_SIDE];
    noted = std::max(noted, static_cast<float>(steps));
}

void ErrorMap::pass() {
    for (std::uint32_t y = 0; y < down_; ++y)
        for (std::uint32_t x = 0; x < across_; ++x) {
            const std::size_t at = y * across_ + x;
            float beside = 0;
            if (x > 0) beside = std::max(beside, noted_[at - 1]);
            if (x + 1 < across_) beside = std::max(beside, noted_[at + 1]);
            if (y > 0) beside = std::max(beside, noted_[at - across_]);
            if (y + 1 < down_) beside = std::max(beside, noted_[at + across_]);
            errors_[at] = std::max({kKept * errors_[at], noted_[at], kSpread * beside});
            if (errors_[at] < kTolerated) errors_[at] = 0;
        }
    std::fill(noted_.begin(), noted_.end(), 0.0f);
}

void ErrorMap::forget() {
    std::fill(errors_.begin(), errors_.end(), 0.0f);
    std::fill(noted_.begin(), noted_.end(), 0.0f);
}

std::vector<std::uint32_t> choosePixels(const CarriedPicture& picture, const ErrorMap& errors,
                                        const Attention& attention) {
    const Chooser chooser(picture, errors, attention);
    const std::uint32_t down = picture.tilesDown();
    std::vector<RowUrgency> rows(down);
    std::vector<std::vector<std::uint32_t>> chosen(down);
    forAll(down, [&](std::size_t row) { rows[row] = chooser.look(static_cast<std::uint32_t>(row)); });
    const float chance = chanceFor(rows, attention.wanted);
    forAll(down,
           [&](std::size_t row) { chosen[row] = chooser.choose(static_cast<std::uint32_t>(row), rows[row], chance); });
    std::vector<std::uint32_t> all;
    for (const std::vector<std::uint32_t>& row : chosen) all.insert(all.end(), row.begin(), row.end());
    return all;
}

} // namespace pointrt
