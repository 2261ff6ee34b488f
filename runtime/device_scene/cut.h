// SPDX-License-Identifier: Apache-2.0
// Which tiles of a set stand for it in a picture: a cut through their tree, which covers the cloud once. All rays of a
// picture see the same one.
#pragma once

#include <cstdint>
#include <vector>

#include "format/set/tile_set.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// What a picture sees of a set, in the set's coordinates.
struct CutView {
    Camera camera;
    double aspect = 1;        ///< width over height
    std::uint32_t height = 1; ///< pixels
};

/// What no camera sees is met by scattered and mirrored rays alone, which spread: a pixel is so many times as large
/// there. Two levels; a set's levels are twice as coarse each.
constexpr double kUnseenPixel = 4;

/// What tiles, and on a processor all of a picture, may take where nothing is said, bytes: 2 GiB.
constexpr std::uint64_t kTileMemory = std::uint64_t{2} << 30;

struct CutRequest {
    std::vector<CutView> views; ///< at least one: pixels are those of whichever sees most of them
    /// Pixels: a tile is fine enough where what it leaves out, its error or the distance of its splats, is no larger.
    /// With 0 none is that has finer ones; with kMaxPixelSide or more, which no picture has, every one is.
    double detail = RenderSettings{}.detail;
    std::uint64_t memory = 0;        ///< bytes that the tiles may take, but for the root's, which is always there
    std::uint32_t splat_bytes = 0;   ///< that a stored splat takes besides the file: its paint, an index that is built
    std::vector<bool> wanted_unseen; ///< of each tile, or empty: many rays meet it though no camera sees it
    std::vector<bool> lost;          ///< of each tile, or empty: it cannot be had, and its parent stands for it
};

struct TileCut {
    std::vector<std::uint32_t> tiles; ///< numbers, rising
    std::uint64_t bytes = 0;          ///< that they take
    bool fits = true;                 ///< else memory ended it: some are coarser than they should be
};

/// Refined from the root down: each time the tile that leaves out the most pixels, of equals the one with the lower
/// number, until all are fine; those whose children would take more than what is left of the memory are passed over.
/// Before a tile is refined those that touch it are, where they are coarser, so that neighbours differ by one level at
/// most; but for original tiles, which have no children. It depends on the arguments alone. children: childrenOf(set)
TileCut chooseCut(const TileSet& set, const std::vector<std::vector<std::uint32_t>>& children,
                  const CutRequest& request);

/// What a tile takes.
std::uint64_t bytesInCut(const SetTile& tile, const CutRequest& request);
/// How many of the view's pixels lie across what a tile leaves out where the camera comes nearest to its core; 0 of
/// original ones. Infinite from within.
double leftOutPixels(const TileSet& set, const SetTile& tile, const CutView& view);
/// The cell so many cells further along each axis; around the ends of their range there is nothing.
TileCell cellBeside(const TileCell& cell, const TileCell& steps);
/// Whether any of the box may be in the picture.
bool isInPicture(const TileBox& box, const CutView& view);

} // namespace pointrt
