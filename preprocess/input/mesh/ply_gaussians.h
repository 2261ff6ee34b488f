// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussians in PLY files: as trained (3DGS, 2DGS), and as SuperSplat packs them.
#pragma once

#include "preprocess/ingest/sink.h"
#include "preprocess/input/mesh/ply_header.h"

namespace pointrt {

/// Reads a file whose header says that it holds Gaussians. Throws Error as readGaussians does, and if packed ones are
/// invalid.
void readPlyGaussians(const InputFile& input, const PlyHeader& header, Sink& sink);

} // namespace pointrt
