// SPDX-License-Identifier: Apache-2.0
// Small scenes with their bricks, and exact intersections of discs and cells to compare these with.
#pragma once

#include "format/index/bricks.h"

#include <gtest/gtest.h>

#include "format/base/error.h"
#include "format/index/cell_skips.h"
#include "runtime/util/vec.h"
#include "tests/format/index/disc_polygon.h"
#include "tests/format/scene_builder.h"
#include "tests/support/index_values.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <random>
#include <set>

namespace pointrt::test::bricks {

constexpr double kStep = PRO_POSITION_STEP;

inline Cube part(const Cube& cube, std::uint32_t side, std::uint32_t cell) {
    const double edge = cube.edge / side;
    const std::uint32_t x = cell % side, y = cell / side % side, z = cell / side / side;
    return {cube.low + Vec3{x * edge, y * edge, z * edge}, edge};
}

/// A scene and its bricks.
struct Loaded {
    Scene scene;
    std::vector<PlainDisc> discs; ///< one per splat
    EntryGrid grid;
    Bricks bricks;
};

inline Loaded load(Scene scene, const BrickLimits& limits = {}) {
    Loaded loaded{std::move(scene), {}, {}, {}};
    const pro_view view = loaded.scene.view();
    const pro_info& info = loaded.scene.info;
    for (std::uint32_t i = 0; i < info.splat_count; ++i) {
        pro_splat splat;
        pro_splat_decode(view.splats + std::size_t{i} * PRO_SPLAT_WORDS, info.radius_max, info.radius_step, &splat);
        loaded.discs.push_back(plainDisc(splat));
    }
    loaded.grid = frameEntryGrid(info, view);
    loaded.bricks = buildBricks(info, view, loaded.grid, {0, {}, limits});
    fillEntryGrid(loaded.grid, loaded.bricks.corners);
    fillCellSkips(loaded.grid, loaded.bricks.corners.size(), loaded.bricks.words);
    return loaded;
}

inline bool isGroup(std::uint32_t word) { return (word & (PRO_SKIP_MASK | PRO_CELL_INNER)) == PRO_CELL_INNER; }

inline Cube gridCube(const Loaded& loaded, std::size_t word) {
    const EntryGrid& grid = loaded.grid;
    const double edge = std::ldexp(1.0, static_cast<int>(grid.shift - PRO_POSITION_BITS));
    const std::size_t x = word % grid.size[0], y = word / grid.size[0] % grid.size[1];
    const std::size_t z = word / grid.size[0] / grid.size[1];
    return {Vec3{static_cast<double>(grid.origin[0] + x), static_cast<double>(grid.origin[1] + y),
                 static_cast<double>(grid.origin[2] + z)} *
                edge,
            edge};
}

/// Calls visit(word, cube) for all cells below a word of a brick or group, skipping cubes for which enter is false.
template <typename Enter, typename Visit>
inline void descend(const Loaded& loaded, std::uint32_t word, const Cube& cube, const Enter& enter,
                    const Visit& visit) {
    if (!enter(cube)) return;
    if (!isGroup(word)) return visit(word, cube);
    for (std::uint32_t h = 0; h < PRO_GROUP_WORDS; ++h)
        descend(loaded, loaded.bricks.words[(word >> PRO_CELL_INDEX_SHIFT) * PRO_GROUP_WORDS + h], part(cube, 2, h),
                enter, visit);
}

/// The same for a word of the grid; visits empty grid cells, too.
template <typename Enter, typename Visit>
inline void descendGrid(const Loaded& loaded, std::size_t at, const Enter& enter, const Visit& visit) {
    const std::uint32_t word = loaded.grid.words[at];
    const Cube cube = gridCube(loaded, at);
    if (!enter(cube)) return;
    if (!isFilled(word)) return visit(word, cube);
    for (std::uint32_t c = 0; c < PRO_BRICK_WORDS; ++c)
        descend(loaded, loaded.bricks.words[(word >> PRO_GRID_BRICK_SHIFT) * PRO_BRICK_WORDS + c],
                part(cube, PRO_BRICK_SIDE, c), enter, visit);
}

template <typename Visit>
inline void forListedCells(const Loaded& loaded, const Visit& visit) {
    const auto all = [](const Cube&) { return true; };
    for (std::size_t at = 0; at < loaded.grid.words.size(); ++at)
        descendGrid(loaded, at, all, [&](std::uint32_t word, const Cube& cube) {
            if (isFilled(word)) visit(word >> PRO_CELL_INDEX_SHIFT, cube);
        });
}

inline std::uint32_t firstOf(const Loaded& loaded, std::uint32_t cell) {
    return loaded.bricks.cells[cell * PRO_CELL_WORDS + PRO_CELL_FIRST];
}
inline std::uint32_t countOf(const Loaded& loaded, std::uint32_t cell) {
    return loaded.bricks.cells[cell * PRO_CELL_WORDS + PRO_CELL_COUNT] & PRO_CELL_COUNT_MASK;
}

/// The splats of the near splats of a cell.
inline std::vector<std::uint32_t> listOf(const Loaded& loaded, std::uint32_t cell) {
    const auto first = loaded.bricks.listed.begin() + firstOf(loaded, cell);
    return {first, first + countOf(loaded, cell)};
}

/// Splats that only blend in a cell.
inline std::vector<std::uint32_t> blendingOf(const Loaded& loaded, std::uint32_t cell) {
    const std::uint32_t* words = &loaded.bricks.cells[std::size_t{cell} * PRO_CELL_WORDS];
    std::vector<std::uint32_t> splats;
    for (std::uint32_t k = 0; k < (words[PRO_CELL_BLENDING_COUNT] & PRO_CELL_BLENDING_MASK); ++k) {
        const std::size_t at = words[PRO_CELL_BLENDING] + k;
        const int number = signedField(loaded.bricks.blending[at / 2], at % 2 ? 16 : 0, 16);
        splats.push_back(loaded.bricks.listed.at(words[PRO_CELL_FIRST] + static_cast<std::size_t>(number)));
    }
    return splats;
}

inline bool contains(const std::vector<std::uint32_t>& list, std::uint32_t value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

/// The grid names each brick once, no brick is empty, and each cell and group is named once.
inline void expectStructure(const Loaded& loaded) {
    const Bricks& bricks = loaded.bricks;
    const std::size_t brick_words = bricks.corners.size() * PRO_BRICK_WORDS;
    EXPECT_EQ(std::set<Corner>(bricks.corners.begin(), bricks.corners.end()).size(), bricks.corners.size());
    std::size_t filled = 0;
    for (std::size_t at = 0; at < loaded.grid.words.size(); ++at) {
        if (!isFilled(loaded.grid.words[at])) continue;
        ++filled;
        const Corner& corner = bricks.corners.at(loaded.grid.words[at] >> PRO_GRID_BRICK_SHIFT);
        EXPECT_EQ(length(Vec3{corner[0] * kStep, corner[1] * kStep, corner[2] * kStep} - gridCube(loaded, at).low), 0);
    }
    EXPECT_EQ(filled, bricks.corners.size());
    for (std::size_t word = 0; word < brick_words; word += PRO_BRICK_WORDS)
        EXPECT_TRUE(std::any_of(&bricks.words[word], &bricks.words[word] + PRO_BRICK_WORDS, isFilled));
    std::multiset<std::uint32_t> cells, groups;
    for (std::size_t w = 0; w < bricks.words.size(); ++w) {
        const std::uint32_t word = bricks.words[w];
        if (isFilled(word)) (isGroup(word) ? groups : cells).insert(word >> PRO_CELL_INDEX_SHIFT);
        EXPECT_TRUE(isFilled(word) || w < brick_words || word == kEmptyWord);
    }
    std::uint32_t cell = 0, group = static_cast<std::uint32_t>(brick_words / PRO_GROUP_WORDS);
    for (const std::uint32_t named : cells) EXPECT_EQ(named, cell++);
    for (const std::uint32_t named : groups) EXPECT_EQ(named, group++);
    EXPECT_EQ(cell, bricks.slabs.size());
    EXPECT_EQ(cell * PRO_CELL_WORDS, bricks.cells.size());
    EXPECT_EQ(group * PRO_GROUP_WORDS, bricks.words.size());
}

/// Runs lie inside the row of near splats, and cells do not share blending numbers.
inline void expectRanges(const Loaded& loaded) {
    const Bricks& bricks = loaded.bricks;
    std::uint64_t numbers = 0;
    for (std::uint32_t cell = 0; cell < bricks.slabs.size(); ++cell) {
        EXPECT_GT(countOf(loaded, cell), 0u);
        EXPECT_LE(firstOf(loaded, cell) + countOf(loaded, cell), bricks.listed.size());
        const std::uint32_t* words = &bricks.cells[std::size_t{cell} * PRO_CELL_WORDS];
        EXPECT_EQ(words[PRO_CELL_BLENDING] % 2, 0u);
        numbers += ((words[PRO_CELL_BLENDING_COUNT] & PRO_CELL_BLENDING_MASK) + 1) / 2 * 2;
    }
    EXPECT_EQ(bricks.near.size(), bricks.listed.size() * PRO_NEAR_WORDS);
    EXPECT_EQ(bricks.listed.size() % 2, 0u);
    EXPECT_EQ(bricks.blending.size() * 2, std::max<std::uint64_t>(numbers, 2));
}

/// Near splat k has the normal and the position, relative to the middle of the cell, of splat listed[k].
inline void expectNear(const Loaded& loaded, std::uint32_t cell, const Cube& cube) {
    const std::uint32_t first = firstOf(loaded, cell), count = countOf(loaded, cell);
    const std::uint32_t offset = loaded.bricks.cells[cell * PRO_CELL_WORDS + PRO_CELL_BLENDING_COUNT];
    const auto part = [&](int axis) {
        return 0.5 +
               0.5 * signedField(offset, PRO_CELL_OFFSET_SHIFT + axis * PRO_CELL_OFFSET_BITS, PRO_CELL_OFFSET_BITS);
    };
    const Vec3 middle = cube.low + Vec3{part(0), part(1), part(2)} * cube.edge;
    for (std::uint32_t k = 0; k < count; ++k) {
        const PlainDisc& disc = loaded.discs.at(loaded.bricks.listed[first + k]);
        const std::uint32_t* words = &loaded.bricks.near[std::size_t{first + k} * PRO_NEAR_WORDS];
        const Vec3 normal{static_cast<double>(signedField(words[1], 24, 8)),
                          static_cast<double>(signedField(words[1], 16, 8)),
                          static_cast<double>(signedField(words[1], 8, 8))};
        EXPECT_LE(length(cross(normalize(normal), disc.normal)), 0.5 * 1.4143 / PRO_NEAR_NORMAL_MAX);
        EXPECT_GT(dot(normal, disc.normal), 0);
        const Vec3 direction{static_cast<double>(signedField(words[0], 22, 10)),
                             static_cast<double>(signedField(words[0], 12, 10)),
                             static_cast<double>(signedField(words[0], 2, 10))};
        if (disc.radius > 8 * cube.edge) continue; // its centre was moved
        const Vec3 center = disc.center - middle;
        EXPECT_LE(length(cross(direction, center)), 1.8 * length(center)); // one code per axis
    }
}

/// Discs that cross a cell are listed in it, and lie between its planes.
struct Found {
    std::uint64_t crossings = 0, unlisted = 0, outside_planes = 0, listed = 0;
};

inline double beyondPlanes(std::uint32_t slab, const Polygon& polygon, const PlainDisc& disc, const Cube& cube) {
    const Vec3 normal = Vec3{static_cast<double>(signedField(slab, 0, 6)), static_cast<double>(signedField(slab, 6, 6)),
                             static_cast<double>(signedField(slab, 12, 6))} *
                        (1.0 / PRO_SLAB_NORMAL_MAX);
    double beyond = 0;
    for (const Vec3& point : polygon) {
        if (length(point - disc.center) > disc.radius) continue;
        const double height = dot(normal, point - cube.low - Vec3{0.5, 0.5, 0.5} * cube.edge) / cube.edge *
                              static_cast<double>(PRO_SLAB_STEPS);
        beyond = std::max({beyond, signedField(slab, 18, 7) - height, height - signedField(slab, 25, 7)});
    }
    return beyond;
}

/// Words of all grid cells that the disc's bounding cube overlaps.
inline std::vector<std::size_t> gridWordsAround(const Loaded& loaded, const PlainDisc& disc) {
    const EntryGrid& grid = loaded.grid;
    const double edge = gridCube(loaded, 0).edge;
    const Vec3 at = (disc.center - gridCube(loaded, 0).low) * (1 / edge);
    std::array<double, 3> center{at.x, at.y, at.z};
    Corner low, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double reach = disc.radius / edge, last = grid.size[axis] - 1;
        low[axis] = static_cast<std::uint32_t>(std::clamp(std::floor(center[axis] - reach), 0.0, last));
        high[axis] = static_cast<std::uint32_t>(std::clamp(std::floor(center[axis] + reach), 0.0, last));
    }
    std::vector<std::size_t> words;
    for (std::size_t z = low[2]; z <= high[2]; ++z)
        for (std::size_t y = low[1]; y <= high[1]; ++y)
            for (std::size_t x = low[0]; x <= high[0]; ++x) words.push_back((z * grid.size[1] + y) * grid.size[0] + x);
    return words;
}

inline Found cutAll(const Loaded& loaded) {
    Found found;
    for (std::uint32_t splat = 0; splat < loaded.discs.size(); ++splat) {
        const PlainDisc& disc = loaded.discs[splat];
        const auto enter = [&](const Cube& cube) { return crosses(disc, cube); };
        const auto visit = [&](std::uint32_t word, const Cube& cube) {
            ++found.crossings;
            if (!isFilled(word) || !contains(listOf(loaded, word >> PRO_CELL_INDEX_SHIFT), splat)) {
                ++found.unlisted;
                return;
            }
            const std::uint32_t slab = loaded.bricks.slabs[word >> PRO_CELL_INDEX_SHIFT];
            found.outside_planes += beyondPlanes(slab, section(disc, cube), disc, cube) > 1e-4;
        };
        for (const std::size_t at : gridWordsAround(loaded, disc)) descendGrid(loaded, at, enter, visit);
    }
    for (std::uint32_t cell = 0; cell < loaded.bricks.slabs.size(); ++cell) found.listed += countOf(loaded, cell);
    return found;
}

/// The listed cell that contains a point, if any.
inline std::optional<std::uint32_t> cellAt(const Loaded& loaded, Vec3 point) {
    const Vec3 low = gridCube(loaded, 0).low;
    const double edge = gridCube(loaded, 0).edge;
    const Vec3 at = (point - low) * (1 / edge);
    const std::array<double, 3> local{std::floor(at.x), std::floor(at.y), std::floor(at.z)};
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (local[axis] < 0 || local[axis] >= loaded.grid.size[axis]) return std::nullopt;
    std::optional<std::uint32_t> cell;
    const auto holds = [&](const Cube& cube) {
        const Vec3 off = point - cube.low;
        return std::min({off.x, off.y, off.z}) >= 0 && std::max({off.x, off.y, off.z}) < cube.edge;
    };
    const double index = local[0] + loaded.grid.size[0] * (local[1] + loaded.grid.size[1] * local[2]);
    descendGrid(loaded, static_cast<std::size_t>(index), holds, [&](std::uint32_t word, const Cube&) {
        if (isFilled(word)) cell = word >> PRO_CELL_INDEX_SHIFT;
    });
    return cell;
}

/// Points of splats' slabs in listed cells that neither list the splat nor blend it.
inline std::size_t missingBlends(const Loaded& loaded) {
    std::size_t missing = 0;
    for (std::uint32_t splat = 0; splat < loaded.discs.size(); ++splat) {
        const PlainDisc& disc = loaded.discs[splat];
        for (int k = 0; k < 60; ++k) {
            const double angle = 2.4 * k, distance = disc.radius * std::sqrt((k + 0.5) / 60.0);
            const double height = 0.99 * loaded.scene.info.blend_slab * disc.radius * (k % 3 - 1);
            const Vec3 point = disc.center + disc.u * (distance * std::cos(angle)) +
                               disc.v * (distance * std::sin(angle)) + disc.normal * height;
            const auto cell = cellAt(loaded, point);
            if (!cell) continue;
            missing += !contains(listOf(loaded, *cell), splat) && !contains(blendingOf(loaded, *cell), splat);
        }
    }
    return missing;
}

/// Lists have no duplicates, and hittable splats are not among those that only blend.
inline void expectDistinct(const Loaded& loaded, std::uint32_t cell) {
    std::vector<std::uint32_t> all = listOf(loaded, cell);
    const std::vector<std::uint32_t> blending = blendingOf(loaded, cell);
    all.insert(all.end(), blending.begin(), blending.end());
    std::sort(all.begin(), all.end());
    EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
}

inline void expectSound(const Loaded& loaded) {
    expectStructure(loaded);
    expectRanges(loaded);
    std::size_t cells = 0;
    forListedCells(loaded, [&](std::uint32_t cell, const Cube& cube) {
        ++cells;
        expectNear(loaded, cell, cube);
        expectDistinct(loaded, cell);
    });
    EXPECT_EQ(cells, loaded.bricks.slabs.size());
    const Found found = cutAll(loaded);
    EXPECT_GT(found.crossings, loaded.discs.size());
    EXPECT_EQ(found.unlisted, 0u) << "of " << found.crossings;
    EXPECT_EQ(found.outside_planes, 0u) << "of " << found.crossings;
    EXPECT_LT(found.listed, 1.15 * static_cast<double>(found.crossings)); // few discs are listed needlessly
    EXPECT_EQ(missingBlends(loaded), 0u);
}

/// 16 octaves of radii, and leaves of any depth.
constexpr test::TreeOptions kOptions{8, 18, 0.5f, 0.25f, 0.0625f};

inline pro_splat disc(Vec3 at, Vec3 normal, double radius) {
    const auto f = [](double value) { return static_cast<float>(value); };
    const Vec3 n = normalize(normal);
    return {{f(at.x), f(at.y), f(at.z)}, {f(n.x), f(n.y), f(n.z)}, f(radius), {255, 255, 255}, 0};
}

/// Encoding rounds radii up, even decoded ones. This grows a radius until it no longer changes, so that the leaves of
/// the scene are built from the radii of its file.
inline pro_splat settled(pro_splat splat) {
    for (float before = 0; before != splat.radius;) {
        std::uint32_t words[PRO_SPLAT_WORDS];
        before = splat.radius;
        pro_splat_encode(&splat, kOptions.radius_max, kOptions.radius_step, words);
        pro_splat_decode(words, kOptions.radius_max, kOptions.radius_step, &splat);
    }
    return splat;
}

/// side^2 overlapping discs on a tilted square of edge size around the middle.
inline std::vector<pro_splat> sheet(int side, double size, Vec3 middle, double radius_factor) {
    const Vec3 normal = normalize({0.3, 0.2, 0.9}), u = normalize(cross(normal, {0, 1, 0})), v = cross(normal, u);
    std::vector<pro_splat> splats;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const double spacing = size / side;
            const Vec3 at = middle + u * (spacing * (i + 0.5) - size / 2) + v * (spacing * (j + 0.5) - size / 2);
            splats.push_back(disc(at, (i + j) % 2 ? normal : normal * -1, radius_factor * spacing));
        }
    return splats;
}

inline std::vector<pro_splat> heap(std::size_t count, unsigned seed, Vec3 low, double size, double radius_max) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::normal_distribution<double> gauss;
    std::vector<pro_splat> splats;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 at = low + Vec3{unit(random), unit(random), unit(random)} * size;
        splats.push_back(
            disc(at, {gauss(random), gauss(random), gauss(random)}, radius_max * std::pow(0.1, unit(random))));
    }
    return splats;
}

inline std::vector<pro_splat> join(std::vector<pro_splat> a, const std::vector<pro_splat>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Counts listed splats as BrickLimits does.
inline std::size_t listedBy(const Bricks& bricks) { return bricks.listed.size() + 2 * bricks.blending.size(); }

inline Loaded loadSplats(std::vector<pro_splat> splats, const BrickLimits& limits = {}) {
    std::transform(splats.begin(), splats.end(), splats.begin(), settled);
    return load(sceneOf(std::move(splats), kOptions), limits);
}

} // namespace pointrt::test::bricks
