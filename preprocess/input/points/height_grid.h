// SPDX-License-Identifier: GPL-3.0-or-later
// Shared by the readers of height grids, whatever their format.
#pragma once

#include <cstdint>

#include "preprocess/ingest/sink.h"

namespace pointrt {

/// Finishes the scan of a grid, notes how many of its cells have no data, and sets its frame, in which z is up.
void finishHeights(const InputFile& input, std::uint64_t missing, std::uint64_t cells, WorldFrame frame, Sink& sink);

} // namespace pointrt
