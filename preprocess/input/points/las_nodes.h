// SPDX-License-Identifier: GPL-3.0-or-later
// Selects nodes of a COPC file.
#pragma once

#include "format/pointio/copc.h"
#include "preprocess/ingest/sink.h"

namespace pointrt {

/// Chunks of the nodes down to the sink's level that overlap the bounds of its filter.
std::vector<LazChunk> selectedNodes(const LasFile& file, const Sink& sink);

} // namespace pointrt
