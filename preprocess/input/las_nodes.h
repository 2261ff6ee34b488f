// SPDX-License-Identifier: GPL-3.0-or-later
// Which nodes of a COPC file a bake wants.
#pragma once

#include "format/pointio/copc.h"
#include "preprocess/input/sink.h"

namespace pointrt {

/// The chunks of nodes down to the sink's level that reach into the bounds of its filter.
std::vector<LazChunk> wantedNodes(const LasFile& file, const Sink& sink);

} // namespace pointrt
