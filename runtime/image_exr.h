// SPDX-License-Identifier: Apache-2.0
// A film as an OpenEXR file: the linear picture and the first hit of each pixel's centre ray.
#pragma once

#include <string>

#include "runtime/render.h"

namespace pointrt {

/// Writes film to path, all or nothing: 32-bit float channels R G B A, Z, N.X N.Y N.Z, P.X P.Y P.Z in ZIP-compressed
/// scan lines. The layout is "OpenEXR File Layout" of openexr.com, single part, version 2.
/// Throws Error kCannotWrite "PATH: reason".
void writeExr(const std::string& path, const Film& film);

} // namespace pointrt
