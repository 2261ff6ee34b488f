// SPDX-License-Identifier: Apache-2.0
// Exports Gaussians as SPZ, the compressed format of https://github.com/nianticlabs/spz
#pragma once

#include <string>

#include "format/info/export_source.h"

namespace pointrt {

/// Writes the Gaussians of source, in its order, as SPZ version 3. Its axes point right, up and back: a scene whose up
/// is -y, as in captures, is rotated by half a turn about x. Deviations are rounded to sixteenths of their logarithm,
/// colours and opacities to bytes, coordinates to 24 bits. Throws Error kCannotWrite, also if path exists and overwrite
/// is false; kBadInput if coordinates are too large for 24 bits, or there are 2^32 Gaussians or more. Holds all of them
/// in memory, in 20 to 65 bytes each.
/// @param source has Gaussians
/// @param path not "-"
void exportSpz(const ExportSource& source, const std::string& path, bool overwrite);

} // namespace pointrt
