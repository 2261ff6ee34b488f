// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of reading LAS files, for formats that keep their points in several of them.
#pragma once

#include "format/pointio/las_crs.h"
#include "preprocess/ingest/sink.h"
#include "preprocess/input/points/las_blocks.h"

namespace pointrt {

/// As openLas, with the file's name in errors.
LasFile openLasInput(const InputFile& input, const Sink& sink);

/// As lazLayout, with the file's name in errors; empty if the points are not compressed.
LazLayout layoutOfLas(const InputFile& input, const LasFile& file, const Sink& sink);

std::vector<LazChunk> allLasChunks(const LasFile& file, const LazLayout& layout);

/// @param points that will be read
ScanTraits lasTraits(const LasFile& file, const std::vector<LasField>& fields, std::uint64_t points);

/// Adds the points to the current scan. If some are malformed, throws Error with the number of valid points, or adds
/// those if the sink salvages.
void addLasPoints(const InputFile& input, LasPlan plan, Sink& sink);

/// Sets the frame of the scan finished last. Up is z in all coordinate systems of LAS files but geocentric ones.
void setLasFrame(const LasCrs& crs, const InputFile& input, Sink& sink);

} // namespace pointrt
