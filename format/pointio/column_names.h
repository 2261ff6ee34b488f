// SPDX-License-Identifier: Apache-2.0
// What the numbers of a column are called where each has a name of its own.
#pragma once

#include <string>
#include <vector>

#include "format/pointio/point_columns.h"

namespace pointrt {

/// One for each component. The names of attributes may hold anything: blanks, control characters, and what is among
/// separators, become '_'.
std::vector<std::string> componentNames(const PointColumn& column, const std::string& separators);

} // namespace pointrt
