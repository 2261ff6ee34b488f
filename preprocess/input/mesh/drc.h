// SPDX-License-Identifier: GPL-3.0-or-later
// Draco data, as a file or inside another file.
#pragma once

#include <cstdint>
#include <optional>

#include "preprocess/ingest/sink.h"

namespace pointrt {

/// Unique ids of attributes that have no type of their own.
struct DracoIds {
    std::optional<std::uint32_t> normals, colors;
};

/// Starts a scan and adds the points and faces of the data, which are all bytes of the input; the caller finishes it.
/// Throws Error if the data is malformed.
void addDraco(const InputFile& input, const DracoIds& ids, Sink& sink);

} // namespace pointrt
