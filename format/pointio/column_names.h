// SPDX-License-Identifier: Apache-2.0
// Names of the components of a column, for formats with a name for each number.
#pragma once

#include <string>
#include <vector>

#include "format/pointio/point_columns.h"

namespace pointrt {

/// One name for each component. Blanks, control characters and separators in names of attributes become '_'.
std::vector<std::string> componentNames(const PointColumn& column, const std::string& separators);

} // namespace pointrt
