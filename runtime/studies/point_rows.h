// SPDX-License-Identifier: Apache-2.0
// From rows of arrays to discs.
#pragma once

#include <cstddef>

#include "pointrt/studies.hpp"
#include "runtime/studies/visibility_ray.h"

namespace pointrt {

/// Throws TraceError kBadUsage if the number of rows of an array is not count, or the rules are invalid.
void requireRows(const StudyPoints& points, std::size_t count, const StudyRules& rules);

/// Throws TraceError kBadInput "point N: ..." if the position is not finite.
StudyDisc discAt(const StudyPoints& points, std::size_t row, const StudyRules& rules);

} // namespace pointrt
