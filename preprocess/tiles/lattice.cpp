// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/lattice.h"

#include <algorithm>
#include <cmath>

namespace pointrt {

namespace {

/// codeIn for one axis. Does not overflow: cells have 32 bits, codes 20, and cells of a level that is higher by n have
/// n bits less.
std::int64_t stepIn(const TileKey& to, const TileKey& from, std::size_t axis, std::int32_t code) {
    std::int64_t step = std::int64_t{from.cell[axis]} * kCoreSteps + code;
    if (from.level > to.level)
        step = (2 * step + 1) << (from.level - to.level - 1);
    else
        step >>= to.level - from.level;
    return step - std::int64_t{to.cell[axis]} * kCoreSteps;
}

} // namespace

std::string nameOf(const TileKey& key) {
    std::string name = std::to_string(key.level);
    for (const std::int32_t each : key.cell) name += "-" + std::to_string(each);
    return name;
}

bool isInCore(const PositionCode& code) {
    return std::all_of(code.begin(), code.end(), [](auto each) { return each >= 0 && each < kCoreSteps; });
}

bool isInCube(const PositionCode& code) {
    return std::all_of(code.begin(), code.end(),
                       [](auto each) { return each >= -kRimSteps && each < kCoreSteps + kRimSteps; });
}

PositionCode codeOf(const TileSet& set, const TileKey& tile, const Vec3d& position) {
    constexpr double kFar = 1 << 30; // the floor of anything below fits in 32 bits
    const TileBox core = coreOf(set, tile.level, tile.cell);
    const double steps = kCoreSteps / edgeOf(set, tile.level);
    PositionCode code;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double step = std::floor((position[axis] - core.low[a]) * steps);
        code[a] = static_cast<std::int32_t>(std::clamp(step, -kFar, kFar));
    }
    return code;
}

Vec3d positionOf(const TileSet& set, const TileKey& tile, const PositionCode& code) {
    const TileBox core = coreOf(set, tile.level, tile.cell);
    const double step = edgeOf(set, tile.level) / kCoreSteps;
    Vec3d position;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        position[axis] = core.low[a] + (code[a] + 0.5) * step;
    }
    return position;
}

std::optional<PositionCode> codeIn(const TileKey& to, const TileKey& from, const PositionCode& code) {
    PositionCode result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t step = stepIn(to, from, axis, code[axis]);
        if (step < -kRimSteps || step >= kCoreSteps + kRimSteps) return std::nullopt;
        result[axis] = static_cast<std::int32_t>(step);
    }
    return result;
}

} // namespace pointrt
