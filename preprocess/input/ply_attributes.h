// SPDX-License-Identifier: GPL-3.0-or-later
// Which properties of a PLY file's vertices are attributes.
#pragma once

#include <string>

#include "preprocess/input/ply_header.h"

namespace pointrt {

/// Gives each numeric property that has no role a place among a vertex's packed values, and colours of 16 bits theirs:
/// header.columns says what is packed. Left out are coordinates in the textures of meshes.
/// Returns the names of what is not read, for a note, or "".
std::string settlePlyAttributes(PlyHeader& header);

} // namespace pointrt
