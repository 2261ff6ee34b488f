// SPDX-License-Identifier: Apache-2.0
// Exports Gaussians as SPZ, the compressed format of https://github.com/nianticlabs/spz
#pragma once

#include <string>

#include "pointrt/pro.hpp"

namespace pointrt {

/// Writes the Gaussians of file, in input order, as SPZ version 3. Its axes point right, up and back: a scene whose up
/// is -y, as captures have it, is turned by half a turn about x. Deviations are rounded to sixteenths of their
/// logarithm, colours and opacities to bytes, coordinates to 24 bits. Throws Error kCannotWrite, also if path exists
/// and overwrite is false; kBadInput if coordinates are too large for 24 bits.
/// @param file has Gaussians
/// @param path not "-"
void exportSpz(const ProFile& file, const std::string& path, bool overwrite);

} // namespace pointrt
