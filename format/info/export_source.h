// SPDX-License-Identifier: Apache-2.0
// The splats that an export writes: those of a file, or of all tiles of a set that hold original ones.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "format/set/tile_set.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// Some splats of a file, by number. Returns false where no more are wanted.
using UseSplats = std::function<bool(const ProFile& file, std::span<const std::uint32_t> splats)>;

/// What is said of all of them, and a way to have them part by part: one file is open at a time.
struct ExportSource {
    pro_info info{};                       ///< flags, bounds, and the scale of the finest; counts are the first file's
    pro_world world{};                     ///< without sensors
    std::vector<pro_attribute> attributes; ///< each file's, in its order; values are those of the one file, else null
    std::string metadata;
    std::uint64_t splats = 0; ///< of all parts
    /// Calls use for each part; false where use returned it.
    std::function<bool(const UseSplats& use)> forEachPart;
};

/// All splats once, in input order (in file order where the file has none), but those that fill gaps. file must live as
/// long.
ExportSource exportSource(const ProFile& file);

/// Those in the cores of tiles without children, tile by tile, each as a file's. Opens every tile of them twice.
/// Throws Error as openTile.
ExportSource exportSource(const TileSet& set, const std::string& folder);

} // namespace pointrt
