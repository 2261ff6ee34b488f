// SPDX-License-Identifier: Apache-2.0
// Splats of .pro files as points with columns.
#pragma once

#include <cstdint>
#include <span>

#include "format/pointio/point_columns.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// Columns are the normal and radius (input units) of each splat, its colour if the file has colours, and all
/// attributes, with ranges and values. count is the number of splats. file must outlive the columns' values.
PointOutline outlineOf(const ProFile& file);

/// Overwrites block with these splats of file. Balls have the normal 0, which means unknown.
/// @param columns from outlineOf, all or some; attributes that file lacks are 0
void gatherPoints(const ProFile& file, std::span<const std::uint32_t> splats, std::span<const PointColumn> columns,
                  PointBlock& block);

} // namespace pointrt
