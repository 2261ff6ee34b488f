// SPDX-License-Identifier: Apache-2.0
// Converts a film to the layers of a caller's picture.
#pragma once

#include <string>
#include <vector>

#include "pointrt/render.hpp"
#include "runtime/image/film.h"

namespace pointrt {

/// True if a layer needs first hits. Throws Error kBadUsage for an unknown layer.
bool wantsFirstHits(const std::vector<std::string>& layers);

/// Moves the layers with these names out of film.
Picture pictureOf(Film film, const std::vector<std::string>& layers);

} // namespace pointrt
