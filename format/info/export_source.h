// SPDX-License-Identifier: Apache-2.0
// The splats to export: those of a file, or of all original tiles of a set.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "format/pointio/point_columns.h"
#include "format/set/tile_set.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// Receives some splats of a file, by index.
using UseSplats = std::function<void(const ProFile& file, std::span<const std::uint32_t> splats)>;

/// The description of all splats, and a way to visit them part by part, with one file open at a time.
struct ExportSource {
    PointOutline outline; ///< with a count; columns of a tile set have no values
    bool has_gaussians = false;
    std::uint32_t harmonics_degree = 0; ///< the largest of any file
    std::array<float, 3> up{};          ///< 0: unknown
    /// Calls use for each part.
    std::function<void(const UseSplats& use)> forEachPart;
};

/// Every splat once, in input order (file order if it is not recorded), except those that fill gaps.
/// @param file must outlive the result
ExportSource exportSource(const ProFile& file);

/// The splats in the cores of original tiles, tile by tile, each in the order of its file. Opens each of these tiles
/// twice. Throws Error as openTile.
ExportSource exportSource(const TileSet& set, const std::string& folder);

} // namespace pointrt
