// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/tiles/pack_tile.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>

#include "preprocess/cloud/curve_key.h"
#include "preprocess/cloud/morton.h"

namespace pointrt {

namespace {

std::uint64_t mortonOf(const PositionCode& code) {
    const auto up = [](std::int32_t each) { return static_cast<std::uint64_t>(each + kRimSteps); };
    return mortonCode(up(code[0]), up(code[1]), up(code[2]));
}

std::vector<CurveKey> sortAlongCurve(const std::vector<PositionCode>& positions) {
    std::vector<CurveKey> keys(positions.size());
    tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t i) {
        keys[i] = {mortonOf(positions[i]), static_cast<std::uint32_t>(i), false};
    });
    tbb::parallel_sort(keys);
    return keys;
}

pro_info frameOf(const TileSet& set, const TileKey& tile, const LevelCoding& coding, const TileSplats& splats) {
    pro_info frame{};
    SetTile row;
    row.level = tile.level;
    row.cell = tile.cell;
    const TileCube cube = cubeOf(set, row);
    frame.scale = cube.scale;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        frame.origin[axis] = cube.origin[axis];
        const auto [low, high] = std::minmax_element(splats.positions.begin(), splats.positions.end(),
                                                     [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
        const auto place = [&](std::int32_t code) {
            return cube.origin[axis] + (code + kRimSteps + 0.5) * (cube.scale / PRO_POSITION_STEPS);
        };
        frame.bounds_min[axis] = place((*low)[axis]);
        frame.bounds_max[axis] = place((*high)[axis]);
    }
    frame.radius_max = coding.radius_max;
    frame.radius_step = coding.radius_step;
    frame.blend_slab = kBlendSlab;
    const bool balls = std::any_of(splats.normals.begin(), splats.normals.end(),
                                   [](std::uint32_t word) { return (word & kBallNormal) != 0; });
    frame.flags = (splats.colors.empty() ? 0u : PRO_FLAG_COLOR) | (set.oriented ? PRO_FLAG_ORIENTED : 0u) |
                  (balls ? PRO_FLAG_BALLS : 0u);
    return frame;
}

/// The middle of its step, which a float holds exactly.
float cubeCoordinate(std::int32_t code) { return (static_cast<float>(code + kRimSteps) + 0.5f) * PRO_POSITION_STEP; }

void packOne(const TileSplats& splats, std::uint32_t i, std::size_t k, PackedSplats& packed) {
    const PositionCode& code = splats.positions[i];
    const Vec3f normal = normalOf(splats.normals[i]);
    const Rgb8 color = splats.colors.empty() ? Rgb8{255, 255, 255} : splats.colors[i];
    const pro_splat plain{{cubeCoordinate(code[0]), cubeCoordinate(code[1]), cubeCoordinate(code[2])},
                          {normal.x(), normal.y(), normal.z()},
                          static_cast<float>(splats.radii[i] / packed.frame.scale),
                          {color[0], color[1], color[2]},
                          0};
    packSplat(plain, k, packed);
    if (!splats.colors.empty()) packed.colors[k] = color;
    if (!splats.noise.empty()) packed.noise[k] = noiseCode(splats.noise[i], packed.discs[k].radius, packed.frame.scale);
}

} // namespace

PackedSplats packTile(const TileSet& set, const TileKey& tile, const LevelCoding& coding, const TileSplats& splats) {
    PackedSplats packed;
    packed.frame = frameOf(set, tile, coding, splats);
    const std::vector<CurveKey> keys = sortAlongCurve(splats.positions);
    const std::size_t count = keys.size();
    packed.words.resize(count);
    packed.discs.resize(count);
    packed.morton.resize(count);
    packed.input_index.resize(count);
    packed.colors.resize(splats.colors.empty() ? 0 : count);
    packed.noise.resize(splats.noise.empty() ? 0 : count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        packOne(splats, keys[k].index, k, packed);
        packed.morton[k] = keys[k].code;
        packed.input_index[k] = keys[k].index;
    });
    dropCleanNoise(packed);
    return packed;
}

} // namespace pointrt
