// SPDX-License-Identifier: GPL-3.0-or-later
// The range grid of a scan while that is read: which vertex is the sample of which cell.
#pragma once

#include <cstdint>
#include <optional>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

struct Sink;
struct Source;

/// Of the scan that is being read.
struct GridBuilder {
    std::optional<RangeGrid> grid;
    std::uint64_t taken = 0;    ///< samples, those left out included
    std::uint64_t left_out = 0; ///< of them
    std::uint64_t clashes = 0;  ///< vertices whose cell was taken
    std::uint64_t beyond = 0;   ///< vertices outside the grid
};

/// Says that the vertices of the scan that has begun are samples of a grid. Takes 4 bytes a cell: the caller has seen
/// that the file has room for as many. A grid of one row or column, or of more cells than points can be told apart, is
/// none, and so is that of points that are handed on in batches.
void beginGrid(Sink& sink, std::uint64_t rows, std::uint64_t columns);

/// Puts a vertex, as addVertex returned it, into its cell. The first one stays in a cell: scanners that hear several
/// echoes of a pulse give all of them its row and column. Does nothing where no grid has begun.
void setCell(Sink& sink, std::uint64_t row, std::uint64_t column, std::uint32_t vertex);

/// Hands the grid of the scan that ends to the cloud, whose last scan that is, its sensor known. What cannot be a grid
/// is left out with a note: vertices outside it, one vertex in two cells, or so many in cells of others that these tell
/// nothing. One of which less than half of the samples stayed says nothing any more, and is left out too.
void finishGrid(Sink& sink, const Source& source);

} // namespace pointrt
