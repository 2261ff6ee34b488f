// SPDX-License-Identifier: GPL-3.0-or-later
// Builds the range grid of a scan while it is read: which vertex is the sample of which cell.
#pragma once

#include <cstdint>
#include <optional>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

class Sink;
struct InputFile;

/// Grid of the current scan.
struct GridBuilder {
    std::optional<RangeGrid> grid;
    std::uint64_t occupied = 0;   ///< cells with a sample, filtered ones included
    std::uint64_t left_out = 0;   ///< filtered ones among them
    std::uint64_t collisions = 0; ///< vertices whose cell was occupied
    std::uint64_t beyond = 0;     ///< vertices outside the grid
    bool too_large = false;       ///< for the memory of reading in batches
};

/// Declares the vertices of the current scan to be samples of a grid. Allocates 4 bytes per cell: the caller must have
/// checked that the file can hold as many. Ignored for a grid of one row or column or of more cells than 32-bit indices
/// distinguish.
void beginGrid(Sink& sink, std::uint64_t rows, std::uint64_t columns);

/// Stores a vertex, as returned by addVertex, in its cell. A cell keeps its first vertex: scanners that record several
/// echoes of a pulse give all of them its row and column. Does nothing without a grid.
void setCell(Sink& sink, std::uint64_t row, std::uint64_t column, std::uint32_t vertex);

/// Moves the grid of the finished scan to the cloud; the scan and its sensor must be there already. Drops an invalid
/// grid with a note: vertices outside it, a vertex in two cells, or too many vertices in occupied cells; and one that
/// takes too much memory. Also drops a grid of which less than half of the samples passed the filters.
void finishGrid(Sink& sink, const InputFile& input);

} // namespace pointrt
