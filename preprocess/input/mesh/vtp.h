// SPDX-License-Identifier: GPL-3.0-or-later
// XML files of VTK: PolyData (.vtp) and UnstructuredGrid (.vtu).
#pragma once

#include <string_view>

#include "preprocess/ingest/input_file.h"

namespace pointrt {

class Sink;

bool isVtp(std::string_view bytes);

/// Reads points, their arrays and the polygons of each piece. Throws Error if the file is malformed.
void readVtp(const InputFile& input, Sink& sink);

} // namespace pointrt
