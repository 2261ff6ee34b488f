// SPDX-License-Identifier: GPL-3.0-or-later
// Selects the properties of a PLY file's vertices that become attributes.
#pragma once

#include <string>

#include "preprocess/input/mesh/ply_header.h"

namespace pointrt {

/// Gives each numeric property without a dimension, and 16-bit colours, a place in a vertex's packed values, which
/// header.columns describes. Skips texture coordinates of meshes.
/// Returns the names of properties that are not read, for a note, or "".
std::string assignPlyAttributes(PlyHeader& header);

} // namespace pointrt
