// SPDX-License-Identifier: Apache-2.0
// A film's arrays as the layers of a caller's picture.
#pragma once

#include <string>
#include <vector>

#include "pointrt/render.hpp"
#include "runtime/image/film.h"

namespace pointrt {

/// Whether one of them is of first hits. Throws Error kBadUsage for a name that no layer has.
bool wantsFirstHits(const std::vector<std::string>& layers);

/// Moves the arrays with these names out of film.
Picture pictureOf(Film film, const std::vector<std::string>& layers);

} // namespace pointrt
