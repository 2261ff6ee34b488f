// SPDX-License-Identifier: Apache-2.0
// Rows of a study's arrays as discs.
#pragma once

#include <cstddef>

#include "pointrt/studies.hpp"
#include "runtime/studies/departure.h"

namespace pointrt {

/// Throws TraceError kBadUsage where the arrays do not have the same number of rows, count, or rules are none.
void requireRows(const StudyPoints& points, std::size_t count, const StudyRules& rules);

/// Throws TraceError kBadInput "point N: ..." where the position is not finite.
StudyDisc discAt(const StudyPoints& points, std::size_t row, const StudyRules& rules);

} // namespace pointrt
