// SPDX-License-Identifier: Apache-2.0
#include "preprocess/tiles/widest_radius.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "preprocess/surface/estimate.h"
#include "preprocess/surface/radii.h"
#include "preprocess/tiles/bake_block.h"
#include "preprocess/tiles/make_tiles.h"
#include "preprocess/tiles/splat_file.h"
#include "set_fixture.h"

namespace pointrt {
namespace {

/// Two tiles of a level, and their parent, whose splats do not count.
TileTree twoTiles(const std::string& folder, const std::vector<float>& radii) {
    std::filesystem::create_directories(folder);
    const TileKey left{0, {0, 0, 0}}, right{0, {1, 0, 0}}, parent{1, {0, 0, 0}};
    TileSplats splats[2], merged;
    const auto add = [](TileSplats& to, float radius) {
        const auto at = static_cast<std::int32_t>(to.radii.size());
        to.positions.push_back({at, 0, 0});
        to.normals.push_back(normalWord({0, 0, 1}));
        to.radii.push_back(radius);
    };
    for (std::size_t i = 0; i < radii.size(); ++i) add(splats[i % 7 == 0], radii[i]);
    for (int i = 0; i < 1000; ++i) add(merged, 100);
    merged.error = 1;
    writeSplats(folder, left, splats[0]);
    writeSplats(folder, right, splats[1]);
    writeSplats(folder, parent, merged);
    return TileTree({left, right});
}

TEST_F(SetTest, TheWidestRadiusIsExact) {
    const std::string splats = folder.file("widest.splats");
    std::mt19937 random(5);
    std::normal_distribution<float> octaves(0, 2);
    std::vector<float> radii(40000);
    for (float& radius : radii) radius = std::exp2(octaves(random));
    const TileTree tree = twoTiles(splats, radii);
    const float widest = findWidestRadius(tree, splats);
    EXPECT_EQ(widest, surface::radiusLimit(radii));
    // once again with limited radii
    for (float& radius : radii) radius = std::min(radius, widest);
    EXPECT_EQ(findWidestRadius(twoTiles(splats, radii), splats), widest);
}

TEST_F(SetTest, FewSplatsHaveNoWidestRadius) {
    const std::string splats = folder.file("few.splats");
    EXPECT_TRUE(std::isinf(findWidestRadius(twoTiles(splats, std::vector<float>(9999, 1.0f)), splats)));
}

/// A hill of 30,000 points, and beside it 25 points ten times as far apart.
TEST_F(SetTest, DiscsOfASetAreAsWideAsThoseOfItsFile) {
    const std::string hill = writeHill("hill.csv", 30000);
    std::string sparse = "x,y,z,intensity\n";
    for (int i = 0; i < 25; ++i) sparse += fmt::format("{},{},0,7\n", 110 + 6 * (i % 5), 40 + 6 * (i / 5));
    const SetRequest request = requestOf({hill, folder.write("sparse.csv", sparse)}, 3000);
    const SetPlan plan = splitInto("A.proset", request);
    bakeBlocks(plan, {0, plan.blocks()}, 2);
    SurfaceReport report;
    const Splats whole = estimateSplats(readInputs(request.inputs, {}), request.bake.surface, report);
    const float of_file = *std::max_element(whole.radii.begin(), whole.radii.end());
    const float of_set = widestRadius(plan, treeOf(plan));
    EXPECT_NEAR(of_set, of_file, 0.02 * of_file); // one splat more or less moves the limit to the adjacent radius
    EXPECT_EQ(widestRadius(plan, treeOf(plan)), of_set); // the stored value
}

} // namespace
} // namespace pointrt
