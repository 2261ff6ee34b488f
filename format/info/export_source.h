// SPDX-License-Identifier: Apache-2.0
// The splats that an export writes: those of a file, or of all tiles of a set that hold original ones.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "format/pointio/point_columns.h"
#include "format/set/tile_set.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// Some splats of a file, by number.
using UseSplats = std::function<void(const ProFile& file, std::span<const std::uint32_t> splats)>;

/// What is said of all of them, and a way to have them part by part: one file is open at a time.
struct ExportSource {
    PointOutline outline; ///< values of columns are those of the one file, else null
    /// Calls use for each part.
    std::function<void(const UseSplats& use)> forEachPart;
};

/// All splats once, in input order (in file order where the file has none), but those that fill gaps. file must live as
/// long.
ExportSource exportSource(const ProFile& file);

/// Those in the cores of tiles without children, tile by tile, each as a file's. Opens every tile of them twice.
/// Throws Error as openTile.
ExportSource exportSource(const TileSet& set, const std::string& folder);

} // namespace pointrt
