// SPDX-License-Identifier: Apache-2.0
// The level-of-detail cut of a tile set: the tiles that a picture is traced with. Together they cover the cloud exactly
// once. All rays of a picture use the same cut.
#pragma once

#include <cstdint>
#include <vector>

#include "format/set/tile_set.h"
#include "runtime/scene/clip.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// The view of a picture, in the set's coordinates.
struct CutView {
    Camera camera;
    double aspect = 1;        ///< width over height
    std::uint32_t height = 1; ///< pixels
};

/// Factor for the size of pixels outside every view: tiles there are reached only by secondary rays, whose footprint is
/// larger. It corresponds to two levels, each twice as coarse as the one below.
constexpr double kUnseenPixelScale = 4;

/// Default memory limit in bytes, 2 GiB: for tiles, or on a CPU device for everything that a picture needs.
constexpr std::uint64_t kTileMemory = std::uint64_t{2} << 30;

struct CutRequest {
    std::vector<CutView> views; ///< at least one; the view in which an error is largest counts
    /// Largest screen-space error to accept, pixels. The error of a tile is its geometric error or the spacing of its
    /// splats. 0 refines to the finest tiles; kMaxPixelSide or more accepts the root.
    double detail = RenderSettings{}.detail;
    std::uint64_t memory = 0;      ///< limit for the tiles, bytes; the root is exempt
    std::uint32_t splat_bytes = 0; ///< bytes per stored splat besides the file: paint, an index that must be built
    /// For each tile outside every view: whether many secondary rays hit it; may be empty.
    std::vector<bool> hit_unseen;
    /// Half-spaces that clips keep, in the set's coordinates; tiles outside are not refined. Empty: no clips.
    std::vector<HalfSpace> kept;
    /// For each tile: whether it could not be opened, so that its parent replaces it; may be empty.
    std::vector<bool> missing;
};

struct TileCut {
    std::vector<std::uint32_t> tiles; ///< numbers, ascending
    std::uint64_t bytes = 0;          ///< of all its tiles
    bool fits = true;                 ///< false: the memory limit left some tiles too coarse
};

/// Refines from the root down, always the tile with the largest screen-space error (the lower number if errors are
/// equal), until all errors are acceptable. Tiles whose children would exceed the memory limit are skipped. Coarser
/// tiles that touch a tile are refined before it, so that neighbours differ by at most one level, except for original
/// tiles, which have no children. The result depends on the arguments alone.
/// @param children childrenOf(set)
TileCut chooseCut(const TileSet& set, const std::vector<std::vector<std::uint32_t>>& children,
                  const CutRequest& request);

/// Bytes of a tile in a cut.
std::uint64_t bytesInCut(const SetTile& tile, const CutRequest& request);
/// The largest screen-space error in a tile, where its core is nearest to the camera, in pixels. 0 for original tiles;
/// infinite if the camera is inside the core.
double screenSpaceError(const TileSet& set, const SetTile& tile, const CutView& view);
/// The cell offset by steps along each axis; wraps at the ends of the range, where no set has tiles.
TileCell cellBeside(const TileCell& cell, const TileCell& steps);
/// Whether any part of the box may be in the picture (conservative).
bool isInPicture(const TileBox& box, const CutView& view);

} // namespace pointrt
