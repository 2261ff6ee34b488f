// SPDX-License-Identifier: Apache-2.0
#include "tests/support/hand_cut_set.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "format/set/open_tile.h"
#include "preprocess/cloud/morton.h"

namespace pointrt::test {

namespace {

/// Range in radii within which splats are copied: their blending range beyond the disc, and one more radius for safety.
constexpr double kRepeatedRadii = 1 + kBlendSlab + 1;

bool isNear(const TileBox& core, const Vec3f& position, double reach) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = static_cast<double>(position[static_cast<int>(axis)]);
        if (at < core.low[axis] - reach || at >= core.high[axis] + reach) return false;
    }
    return true;
}

pro_info frameOf(const TileCube& cube, float radius_max, const Splats& splats) {
    pro_info frame{};
    frame.scale = cube.scale;
    std::copy(cube.origin.begin(), cube.origin.end(), frame.origin);
    frame.radius_max = static_cast<float>(static_cast<double>(radius_max) / cube.scale);
    frame.blend_slab = kBlendSlab;
    const bool balls = std::any_of(splats.normals.begin(), splats.normals.end(), [](auto& n) { return n.isZero(0); });
    frame.flags = (splats.colors.empty() ? 0u : PRO_FLAG_COLOR) | (splats.oriented ? PRO_FLAG_ORIENTED : 0u) |
                  (balls ? PRO_FLAG_BALLS : 0u);
    std::fill_n(frame.bounds_min, 3, 1e300);
    std::fill_n(frame.bounds_max, 3, -1e300);
    return frame;
}

struct Coded {
    std::uint64_t morton = 0;
    std::uint32_t splat = 0;
    Vec3f center; ///< cube units, in the middle of the position step
};

Coded codeOf(const pro_info& frame, const Splats& splats, std::uint32_t splat) {
    Coded coded;
    coded.splat = splat;
    std::uint32_t codes[3];
    for (int axis = 0; axis < 3; ++axis) {
        const double cube = (static_cast<double>(splats.positions[splat][axis]) - frame.origin[axis]) / frame.scale;
        codes[axis] = static_cast<std::uint32_t>(cube * PRO_POSITION_STEPS);
        coded.center[axis] = (static_cast<float>(codes[axis]) + 0.5f) * PRO_POSITION_STEP;
    }
    coded.morton = mortonCode(codes[0], codes[1], codes[2]);
    return coded;
}

PackedSplats packInto(pro_info frame, const Splats& splats, const std::vector<std::uint32_t>& chosen) {
    std::vector<Coded> all;
    for (const std::uint32_t splat : chosen) all.push_back(codeOf(frame, splats, splat));
    std::sort(all.begin(), all.end(), [](const Coded& a, const Coded& b) { return a.morton < b.morton; });
    PackedSplats packed;
    for (const Coded& each : all) {
        const Vec3f& normal = splats.normals[each.splat];
        const Rgb8 color = splats.colors.empty() ? Rgb8{255, 255, 255} : splats.colors[each.splat];
        const pro_splat plain{{each.center.x(), each.center.y(), each.center.z()},
                              {normal.x(), normal.y(), normal.z()},
                              frame.radius_max,
                              {color[0], color[1], color[2]},
                              0};
        std::array<std::uint32_t, PRO_SPLAT_WORDS> words;
        pro_splat_encode(&plain, frame.radius_max, 0, words.data());
        pro_splat read;
        pro_splat_decode(words.data(), frame.radius_max, 0, &read);
        if (normal.isZero(0)) pro_splat_set_ball(words.data());
        packed.words.push_back(words);
        packed.discs.push_back({each.center, normal.isZero(0) ? normal : Vec3f(read.normal), read.radius});
        packed.morton.push_back(each.morton);
        packed.input_index.push_back(each.splat);
        if (!splats.colors.empty()) packed.colors.push_back(color);
        for (int axis = 0; axis < 3; ++axis) {
            const double at = static_cast<double>(splats.positions[each.splat][axis]);
            frame.bounds_min[axis] = std::min(frame.bounds_min[axis], at);
            frame.bounds_max[axis] = std::max(frame.bounds_max[axis], at);
        }
    }
    packed.frame = frame;
    return packed;
}

/// Fills in the entry of the file. Writes no file if the tile has no splats of its own.
bool writeTile(const std::string& folder, const TileSet& set, const Splats& splats, float radius_max, SetTile& tile) {
    const TileBox core = coreOf(set, tile);
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t i = 0; i < splats.positions.size(); ++i) {
        tile.splats += isNear(core, splats.positions[i], 0);
        if (isNear(core, splats.positions[i], kRepeatedRadii * static_cast<double>(radius_max))) chosen.push_back(i);
    }
    if (tile.splats == 0) return false;
    const PackedSplats packed = packInto(frameOf(cubeOf(set, tile), radius_max, splats), splats, chosen);
    const Octree octree = buildOctree(packed, {});
    ProContent content;
    content.materials = {matteRow(1, 1, 1)};
    content.metadata = "{}";
    tile.file = tileFileName(tile.level, tile.cell);
    const std::string path = folder + "/" + tile.file;
    writePro(path, true, makeSections(packed, octree, content), nullptr);
    describeTile(folder, tile);
    return true;
}

} // namespace

TileSet writeHandCutSet(const std::string& folder, const HandCutSet& hand, const Splats& splats,
                        const Splats& root_splats) {
    std::filesystem::create_directories(folder + "/tiles");
    TileSet set;
    set.lattice_origin = hand.lattice_origin;
    set.edge = hand.edge;
    set.oriented = splats.oriented;
    set.colors = !splats.colors.empty();
    set.levels.resize(2);
    for (std::uint32_t level = 0; level < 2; ++level)
        set.levels[level].radius_max =
            static_cast<float>(static_cast<double>(hand.radius_max) / (2 * edgeOf(set, level)));
    SetTile root;
    root.level = 1;
    root.error = hand.error;
    if (writeTile(folder, set, root_splats, hand.radius_max, root)) set.tiles.push_back(root);
    for (int place = 0; place < 8; ++place) {
        SetTile tile;
        tile.cell = {place & 1, place >> 1 & 1, place >> 2};
        if (std::max({tile.cell[0], tile.cell[1], tile.cell[2]}) >= hand.cells) continue;
        if (writeTile(folder, set, splats, hand.radius_max, tile)) set.tiles.push_back(tile);
    }
    set.bounds_min.fill(1e300);
    set.bounds_max.fill(-1e300);
    for (const Vec3f& position : splats.positions)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = static_cast<double>(position[static_cast<int>(axis)]);
            set.bounds_min[axis] = std::min(set.bounds_min[axis], at);
            set.bounds_max[axis] = std::max(set.bounds_max[axis], at);
        }
    arrangeTiles(set);
    writeTileSet(set, folder);
    return set;
}

} // namespace pointrt::test
