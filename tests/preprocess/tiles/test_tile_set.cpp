// SPDX-License-Identifier: Apache-2.0
// Complete sets of known surfaces: the exact contents of each tile.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "format/base/error.h"
#include "pointrt/pro.h"
#include "preprocess/tiles/finish_set.h"
#include "preprocess/tiles/merge_tile.h"
#include "tests/support/cloud_set.h"
#include "tests/support/splat_scenes.h"

namespace pointrt::test {
namespace {

/// Input coordinates, exact, and the words after the position.
struct StoredSplat {
    std::array<double, 3> position;
    std::uint32_t normal_word, color_word;
    double radius;
    auto operator<=>(const StoredSplat&) const = default;
};

struct StoredTile {
    SetTile row;
    std::vector<StoredSplat> own, repeats;
};

bool isIn(const TileBox& box, const std::array<double, 3>& position) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (position[axis] < box.low[axis] || position[axis] >= box.high[axis]) return false;
    return true;
}

StoredTile load(const CloudSet& made, const SetTile& row) {
    pro_file* file = nullptr;
    pro_message message{};
    const std::string path = made.folders.set + "/" + row.file;
    if (pro_open(path.c_str(), 0, &file, &message) != PRO_OK) throw Error(ExitCode::kBadInput, message.text);
    const std::unique_ptr<pro_file, decltype(&pro_close)> closed(file, pro_close);
    pro_info info;
    pro_view view;
    pro_get_info(file, &info);
    pro_get_view(file, &view);
    StoredTile tile{row, {}, {}};
    const TileBox core = coreOf(made.set, row);
    for (std::uint32_t i = 0; i < info.splat_count; ++i) {
        const std::uint32_t* words = view.splats + 4 * i;
        pro_splat splat;
        pro_splat_decode(words, info.radius_max, info.radius_step, &splat);
        StoredSplat stored{{}, words[2], words[3], double{splat.radius} * info.scale};
        for (std::size_t axis = 0; axis < 3; ++axis)
            stored.position[axis] = info.origin[axis] + info.scale * double{splat.position[axis]};
        (isIn(core, stored.position) ? tile.own : tile.repeats).push_back(stored);
    }
    return tile;
}

std::vector<StoredTile> loadAll(const CloudSet& made) {
    std::vector<StoredTile> tiles;
    for (const SetTile& row : made.set.tiles) tiles.push_back(load(made, row));
    return tiles;
}

Splats scene() {
    const Splats plane = squareSplats(80, {0.3f, 0.1f, -0.6f}, {1.7f, 0.2f, 0.1f}, {0, 1.6f, 0.3f});
    Splats both = joinSplats(plane, sphereSplats(4000, {0.2f, 0.1f, 0.5f}, 0.9f));
    paint(both, {200, 100, 50});
    for (std::size_t i = 0; i < both.positions.size(); ++i) both.input_index[i] = static_cast<std::uint32_t>(i);
    both.input_count = static_cast<std::uint32_t>(both.positions.size());
    both.origin = {100, 2000, 30};
    both.oriented = true;
    return both;
}

CloudSet makeScene(double edge, const std::string& name) {
    const Splats splats = scene();
    Attribute numbers{"number", Scalar::kU32, 1, std::vector<char>(4 * splats.positions.size())};
    for (std::uint32_t i = 0; i < splats.positions.size(); ++i) std::memcpy(&numbers.values[4 * i], &i, 4);
    CloudSetOptions options;
    options.edge = edge;
    options.tiles.prune = false;
    options.tiles.index = false;
    const std::string folder = temporaryPath(name);
    std::filesystem::remove_all(folder);
    std::filesystem::remove_all(folder + ".splats");
    return writeCloudSet(folder, splats, {numbers}, options);
}

TEST(TileSetMaking, ReadsBackWithCompleteTiles) {
    const CloudSet made = makeScene(1, "whole.proset");
    const TileSet read = readTileSet(made.folders.set);
    ASSERT_EQ(read.tiles.size(), made.set.tiles.size());
    EXPECT_GT(read.tiles.size(), 10u);
    for (const SetTile& row : read.tiles) {
        const std::string path = made.folders.set + "/" + row.file;
        EXPECT_EQ(std::filesystem::file_size(path), row.bytes);
        std::size_t findings = 1;
        EXPECT_EQ(pro_verify(path.c_str(), nullptr, nullptr, &findings, nullptr), PRO_OK);
        EXPECT_EQ(findings, 0u) << row.file;
    }
    ASSERT_EQ(read.attributes.size(), 1u);
    EXPECT_EQ(read.attributes[0].high, 80.0 * 80 + 4000 - 1);
}

/// Tiles repeat splats of their neighbours bit for bit, so that a surface does not change from tile to tile.
TEST(TileSetMaking, RepeatedSplatsAreIdenticalToTheNeighbours) {
    const std::vector<StoredTile> tiles = loadAll(makeScene(0.5, "repeats.proset"));
    for (std::uint32_t level = 0; level < 3; ++level) {
        std::map<StoredSplat, int> own;
        std::size_t repeats = 0;
        for (const StoredTile& tile : tiles)
            if (tile.row.level == level)
                for (const StoredSplat& splat : tile.own) ++own[splat];
        for (const StoredTile& tile : tiles) {
            if (tile.row.level != level) continue;
            EXPECT_EQ(tile.own.size(), tile.row.splats);
            EXPECT_EQ(tile.own.size() + tile.repeats.size(), tile.row.stored);
            for (const StoredSplat& splat : tile.repeats) EXPECT_TRUE(own.contains(splat));
            repeats += tile.repeats.size();
        }
        EXPECT_GT(repeats, 100u);
    }
}

TEST(TileSetMaking, CoresHoldEverySplatOnce) {
    const Splats splats = scene();
    const CloudSet made = makeScene(0.5, "union.proset");
    const double step = 0.5 / kCoreSteps;
    std::map<std::array<std::int64_t, 3>, std::size_t> places;
    const auto placeOf = [&](const Vec3d& position) {
        std::array<std::int64_t, 3> place;
        for (int axis = 0; axis < 3; ++axis)
            place[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(position[axis] / step));
        return place;
    };
    for (std::size_t i = 0; i < splats.positions.size(); ++i)
        places[placeOf(splats.origin + splats.positions[i].cast<double>())] = i;
    std::size_t own = 0;
    for (const StoredTile& tile : loadAll(made)) {
        if (!tile.row.isOriginal()) continue;
        for (const StoredSplat& splat : tile.own) {
            const auto found = places.find(placeOf({splat.position[0], splat.position[1], splat.position[2]}));
            ASSERT_NE(found, places.end()) << "missing, or present twice";
            const std::size_t i = found->second;
            EXPECT_GE(splat.radius, 0.99999 * splats.radii[i]); // codes are rounded up
            EXPECT_LE(splat.radius, 1.02 * splats.radii[i]);
            EXPECT_GT(normalOf(splat.normal_word).dot(splats.normals[i]), 0.99999f);
            EXPECT_EQ(splat.color_word & 0xFFFFFF, 200u | 100u << 8 | 50u << 16);
            places.erase(found);
        }
        own += tile.own.size();
    }
    EXPECT_EQ(own, splats.positions.size());
    EXPECT_EQ(made.set.splats, own);
}

TileBox grown(TileBox box, double by) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] -= by;
        box.high[axis] += by;
    }
    return box;
}

/// A random position within one radius of a splat's slab.
std::array<double, 3> placeNear(const StoredSplat& splat, std::mt19937& random) {
    std::uniform_real_distribution<double> both(-1, 1);
    const Vec3d normal = normalOf(splat.normal_word).cast<double>();
    Vec3d in_disc, in_ball;
    do in_disc = Vec3d(both(random), both(random), both(random));
    while (in_disc.norm() > 1);
    do in_ball = Vec3d(both(random), both(random), both(random));
    while (in_ball.norm() > 1);
    in_disc -= normal.dot(in_disc) * normal;
    const Vec3d way = splat.radius * (in_disc + kBlendSlab * both(random) * normal + in_ball);
    return {splat.position[0] + way.x(), splat.position[1] + way.y(), splat.position[2] + way.z()};
}

/// A splat whose slab comes within one radius of a core is in that core's tile.
TEST(TileSetMaking, EverySplatNearACoreIsInItsTile) {
    const CloudSet made = makeScene(0.5, "reach.proset");
    const std::vector<StoredTile> tiles = loadAll(made);
    std::mt19937 random(7);
    std::size_t needed = 0;
    for (const StoredTile& tile : tiles) {
        const std::set<StoredSplat> held(tile.repeats.begin(), tile.repeats.end());
        const TileBox core = coreOf(made.set, tile.row);
        for (const StoredTile& other : tiles) {
            if (other.row.level != tile.row.level || other.row.cell == tile.row.cell) continue;
            for (const StoredSplat& splat : other.own) {
                if (!isIn(grown(core, 2.2 * splat.radius), splat.position)) continue;
                bool reaches = false;
                for (int i = 0; i < 20 && !reaches; ++i) reaches = isIn(core, placeNear(splat, random));
                if (!reaches) continue;
                ++needed;
                ASSERT_TRUE(held.contains(splat)) << tile.row.file << " lacks one of " << other.row.file;
            }
        }
    }
    EXPECT_GT(needed, 1000u);
}

/// Two adjacent tiles of different levels: the finer tile repeats splats of the coarser one, coded on its own lattice.
TEST(TileSetMaking, SplatsOfOtherLevelsAreRecoded) {
    const TileKey coarse{1, {0, 0, 0}}, fine{0, {2, 0, 0}};
    TileSplats left, right;
    for (std::int32_t k = 0; k < 50; ++k) {
        left.positions.push_back({kCoreSteps - 1 - 40 * k, 1000 * k, 7});
        right.positions.push_back({40 * k, 1000 * k, 7});
    }
    for (TileSplats* each : {&left, &right}) {
        each->normals.assign(50, normalWord({0, 0, 1}));
        each->radii.assign(50, 0.01f);
    }
    const std::string folder = temporaryPath("levels.splats");
    std::filesystem::create_directories(folder);
    std::filesystem::create_directories(folder + "/tiles");
    writeSplats(folder, coarse, left);
    writeSplats(folder, fine, right);
    mergeTile(folder, {1, {1, 0, 0}}, {fine}, 2, 1000, true);
    mergeTile(folder, {2, {0, 0, 0}}, {coarse, {1, {1, 0, 0}}}, 4, 1000, true);
    CloudSet made{{}, TileTree({coarse, fine}), {folder, folder}};
    made.set.edge = 1;
    const auto codings = readLevelCodings(made.tree, 1, folder);
    TileOptions options;
    options.prune = options.index = false;
    const StoredTile of_fine = load(made, *buildTile(made.set, made.tree, fine, codings, made.folders, options));
    const StoredTile of_coarse = load(made, *buildTile(made.set, made.tree, coarse, codings, made.folders, options));
    EXPECT_EQ(of_fine.own.size(), 50u);
    EXPECT_EQ(of_coarse.own.size(), 50u);
    EXPECT_EQ(of_fine.repeats.size(), 50u);
    EXPECT_EQ(of_coarse.repeats.size(), 50u);
    const std::set<StoredSplat> here(of_coarse.own.begin(), of_coarse.own.end());
    for (const StoredSplat& there : of_fine.repeats) {
        const auto same = std::find_if(here.begin(), here.end(), [&](const StoredSplat& splat) {
            double most = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                most = std::max(most, std::abs(splat.position[axis] - there.position[axis]));
            return most <= 0.5 / kCoreSteps; // half a step of the finer level
        });
        EXPECT_NE(same, here.end());
    }
}

} // namespace
} // namespace pointrt::test
