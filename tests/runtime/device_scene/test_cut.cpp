// SPDX-License-Identifier: Apache-2.0
// Cuts and boxes of small sets whose pixels can be counted by hand.
#include <gtest/gtest.h>

#include <limits>

#include "runtime/device_scene/core_reach.h"
#include "runtime/device_scene/cut.h"
#include "runtime/device_scene/opened_set.h"

namespace pointrt {
namespace {

using TileNumbers = std::vector<std::uint32_t>;

SetTile tileAt(std::uint32_t level, TileCell cell, double error) {
    SetTile tile;
    tile.level = level;
    tile.cell = cell;
    tile.error = error;
    tile.splats = tile.stored = 1;
    tile.bytes = 100;
    return tile;
}

TileSet setOf(std::size_t levels, std::vector<SetTile> tiles) {
    TileSet set;
    set.edge = 1;
    set.levels.resize(levels);
    for (SetLevel& level : set.levels) level.radius_max = 1.0 / 16; // in a cube of two edges: an eighth of an edge
    set.tiles = std::move(tiles);
    arrangeTiles(set);
    return set;
}

/// 0: the root, x from 0 to 4; 1 and 2: its halves; 3 to 6: the quarters.
TileSet rowOfFour() {
    return setOf(3,
                 {tileAt(2, {0, 0, 0}, 0.4), tileAt(1, {0, 0, 0}, 0.2), tileAt(1, {1, 0, 0}, 0.2),
                  tileAt(0, {0, 0, 0}, 0), tileAt(0, {1, 0, 0}, 0), tileAt(0, {2, 0, 0}, 0), tileAt(0, {3, 0, 0}, 0)});
}

/// A view from x = -1 along x, 90 degrees high: at a distance of d a pixel is 2 d / height.
CutView fromTheLeft(std::uint32_t height) {
    CutView view;
    view.camera = {{-1, 0.5, 0.5}, {0, -1, 0}, {0, 0, 1}, {1, 0, 0}, 90, 0};
    view.height = height;
    return view;
}

CutRequest requestOf(CutView view) {
    CutRequest request;
    request.views = {view};
    request.memory = 1'000'000;
    return request;
}

TileCut cutOf(const TileSet& set, const CutRequest& request) { return chooseCut(set, childrenOf(set), request); }

TEST(Cut, ShiftedCameras_AreSupported) {
    // the principal point is on the right border: the picture covers y from 0.5 to 4.5 at x = 1
    CutView view = fromTheLeft(100);
    view.camera.forward = view.camera.forward - view.camera.right;
    const TileBox left{{1, 3, 0}, {1.1, 3.1, 1}}, right{{1, 0.2, 0}, {1.1, 0.3, 1}}, far_left{{1, 5, 0}, {1.1, 5.1, 1}};
    EXPECT_TRUE(isInPicture(left, view));
    EXPECT_FALSE(isInPicture(right, view));
    EXPECT_FALSE(isInPicture(far_left, view));
    view.camera.right = 2.0 * view.camera.right; // pixels twice as wide as high
    view.camera.forward = {1, 0, 0};
    EXPECT_TRUE(isInPicture(left, view));
    EXPECT_TRUE(isInPicture(right, view));
    EXPECT_FALSE(isInPicture(far_left, view));
}

TEST(Cut, ScreenSpaceError_IsThatOfTheNearestPoint) {
    const TileSet set = rowOfFour();
    EXPECT_NEAR(screenSpaceError(set, set.tiles[0], fromTheLeft(100)), 0.4 / 0.02, 1e-9);
    EXPECT_NEAR(screenSpaceError(set, set.tiles[2], fromTheLeft(100)), 0.2 / 0.06, 1e-9);
    EXPECT_EQ(screenSpaceError(set, set.tiles[3], fromTheLeft(100)), 0);
    SetTile sparse = set.tiles[2];
    sparse.spacing = 0.6; // more than its error
    EXPECT_NEAR(screenSpaceError(set, sparse, fromTheLeft(100)), 0.6 / 0.06, 1e-9);
    CutView parallel = fromTheLeft(100);
    parallel.camera.ortho_height = 5;
    EXPECT_NEAR(screenSpaceError(set, set.tiles[2], parallel), 0.2 / 0.05, 1e-9);
    CutView within = fromTheLeft(100);
    within.camera.eye = {1, 0.5, 0.5};
    EXPECT_EQ(screenSpaceError(set, set.tiles[0], within), std::numeric_limits<double>::infinity());
}

TEST(Cut, Refinement_StopsBelowAPixel) {
    const TileSet set = rowOfFour();
    EXPECT_EQ(cutOf(set, requestOf(fromTheLeft(100))).tiles, (TileNumbers{3, 4, 5, 6})); // 20, 10 and 3.3 pixels
    EXPECT_EQ(cutOf(set, requestOf(fromTheLeft(12))).tiles, (TileNumbers{2, 3, 4}));     // 2.4, 1.2 and 0.4
    EXPECT_EQ(cutOf(set, requestOf(fromTheLeft(9))).tiles, (TileNumbers{1, 2}));         // 1.8, 0.9 and 0.3
    EXPECT_EQ(cutOf(set, requestOf(fromTheLeft(4))).tiles, TileNumbers{0});              // 0.8
}

TEST(Cut, Detail_IsTheErrorInPixels) {
    const TileSet set = rowOfFour();
    CutRequest request = requestOf(fromTheLeft(100)); // 20, 10 and 3.3 pixels
    EXPECT_EQ(request.detail, 1);
    request.detail = 4;
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{2, 3, 4}));
    request.detail = 9.9;
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{2, 3, 4}));
    request.detail = 10.1;
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{1, 2}));
    request.detail = 20.1;
    EXPECT_EQ(cutOf(set, request).tiles, TileNumbers{0});
}

TEST(Cut, DetailZero_TakesTheFinestTiles) {
    const TileSet set = rowOfFour();
    CutRequest request = requestOf(fromTheLeft(1)); // a fifth of a pixel
    request.views[0].camera.forward = {-1, 0, 0};   // and no camera sees it
    request.views[0].camera.right = {0, 1, 0};
    EXPECT_EQ(cutOf(set, request).tiles, TileNumbers{0});
    request.detail = 0;
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{3, 4, 5, 6}));
    request.memory = 399; // the limit applies nevertheless
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{2, 3, 4}));
    EXPECT_FALSE(cutOf(set, request).fits);
}

TEST(Cut, TilesThatAreCutAway_StayCoarse) {
    const TileSet set = rowOfFour();
    CutRequest request = requestOf(fromTheLeft(100));
    request.kept = {{{3.2, 0, 0}, {1, 0, 0}}}; // beyond x = 2, where tile 1 ends, by more than half its edge
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{1, 5, 6}));
    request.kept = {nothingKept()};
    EXPECT_EQ(cutOf(set, request).tiles, TileNumbers{0});
}

TEST(Cut, LargestDetail_TakesTheRoot) {
    const TileSet set = rowOfFour();
    CutRequest request = requestOf(fromTheLeft(100));
    request.views[0].camera.eye = {1.5, 0.5, 0.5}; // inside: the error is infinite
    request.detail = kMaxPixelSide - 1;
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{2, 3, 4}));
    request.detail = kMaxPixelSide;
    EXPECT_EQ(cutOf(set, request).tiles, TileNumbers{0});
}

TEST(Cut, Memory_LimitsTheCut) {
    const TileSet set = rowOfFour();
    CutRequest request = requestOf(fromTheLeft(100));
    request.memory = 399;
    const TileCut cut = cutOf(set, request);
    EXPECT_EQ(cut.tiles, (TileNumbers{2, 3, 4})); // the left half has the larger error
    EXPECT_EQ(cut.bytes, 300u);
    EXPECT_FALSE(cut.fits);
    request.memory = 400;
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{3, 4, 5, 6}));
    EXPECT_TRUE(cutOf(set, request).fits);
    request.splat_bytes = 16;
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{2, 3, 4}));
    EXPECT_EQ(cutOf(set, request).bytes, 348u);
    request.splat_bytes = 0;
    TileSet heavy = set;
    heavy.tiles[3].bytes = 1000; // tiles that do not fit are skipped
    EXPECT_EQ(cutOf(heavy, request).tiles, (TileNumbers{1, 5, 6}));
    request.memory = 0; // the root is exempt
    EXPECT_EQ(cutOf(set, request).tiles, TileNumbers{0});
}

TEST(Cut, UnseenTiles_MayBeCoarser) {
    const TileSet set = rowOfFour();
    CutRequest request = requestOf(fromTheLeft(29)); // 5.8, 2.9 and 0.97 pixels
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{2, 3, 4}));
    request.views[0].camera.forward = {-1, 0, 0}; // 1.45, 0.73 and 0.24
    request.views[0].camera.right = {0, 1, 0};
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{1, 2}));
    request.hit_unseen.assign(7, false);
    request.hit_unseen[1] = true;
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{2, 3, 4}));
}

TEST(Cut, SeveralCameras_EachGetTheirDetail) {
    const TileSet set = rowOfFour();
    CutRequest request = requestOf(fromTheLeft(12));
    CutView other = fromTheLeft(12);
    other.camera = {{5, 0.5, 0.5}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, 90, 0}; // the mirror image
    request.views.push_back(other);
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{3, 4, 5, 6}));
}

TEST(Cut, MissingTiles_AreReplacedByParents) {
    const TileSet set = rowOfFour();
    CutRequest request = requestOf(fromTheLeft(100));
    request.missing.assign(7, false);
    request.missing[4] = true;
    EXPECT_EQ(cutOf(set, request).tiles, (TileNumbers{1, 5, 6}));
    request.missing[2] = true;
    EXPECT_EQ(cutOf(set, request).tiles, TileNumbers{0});
}

/// 0: the root, x from 0 to 8; 1: its left half; 2: its right half, with a negligible error; 3: from 2 to 4; 4: from 4
/// to 6; 5: from 3 to 4; 6: from 4 to 5.
TileSet steepSteps() {
    return setOf(4,
                 {tileAt(3, {0, 0, 0}, 8), tileAt(2, {0, 0, 0}, 4), tileAt(2, {1, 0, 0}, 1e-6), tileAt(1, {1, 0, 0}, 2),
                  tileAt(1, {2, 0, 0}, 5e-7), tileAt(0, {3, 0, 0}, 0), tileAt(0, {4, 0, 0}, 0)});
}

TEST(Cut, Neighbors_DifferByAtMostOneLevel) {
    const TileSet set = steepSteps();
    EXPECT_EQ(cutOf(set, requestOf(fromTheLeft(100))).tiles, (TileNumbers{4, 5}));
}

TEST(Cut, HitBox_ExtendsWhereNoOtherTileIs) {
    const TileSet set = steepSteps();
    std::vector<bool> in_cut(7, false);
    in_cut[4] = in_cut[5] = true;
    // on the right by the coarser tile's error; where there is no tile, by an eighth of an edge
    const TileBox fine = hitBox(set, in_cut, 5);
    EXPECT_DOUBLE_EQ(fine.low[0], 3 - 0.125);
    EXPECT_DOUBLE_EQ(fine.high[0], 4 + 5e-7);
    EXPECT_DOUBLE_EQ(fine.low[1], -0.125);
    EXPECT_DOUBLE_EQ(fine.high[2], 1.125);
    // on the left a finer tile covers only a part of that side
    const TileBox coarse = hitBox(set, in_cut, 4);
    EXPECT_DOUBLE_EQ(coarse.low[0], 4 - 0.25);
    EXPECT_DOUBLE_EQ(coarse.high[0], 6.25);
    const TileSet row = rowOfFour();
    const TileBox inner = hitBox(row, {false, false, false, true, true, true, true}, 4);
    EXPECT_EQ(inner.low[0], 1);
    EXPECT_EQ(inner.high[0], 2);
}

TEST(Cut, View_IsInTheCoordinatesOfThePlacedSet) {
    Placement placement;
    placement.rotation = {Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}}; // world x is the set's y
    placement.scale = 2;
    placement.translation = {10, 0, 0};
    const Camera camera{{14, 6, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, 50, 8};
    const CutView view = cutView(placement, camera, {300, 100});
    EXPECT_EQ(view.camera.eye, (Vec3{-3, 2, 0}));
    EXPECT_EQ(view.camera.forward, (Vec3{0, 1, 0}));
    EXPECT_EQ(view.camera.right, (Vec3{-1, 0, 0}));
    EXPECT_EQ(view.camera.ortho_height, 4);
    EXPECT_EQ(view.aspect, 3);
    EXPECT_EQ(view.height, 100u);
}

} // namespace
} // namespace pointrt
