// SPDX-License-Identifier: Apache-2.0
// Splats of .pro files as points with columns.
#pragma once

#include <cstdint>
#include <span>

#include "format/pointio/point_columns.h"
#include "pointrt/pro.hpp"

namespace pointrt {

/// Columns: the normal and radius (input units) of each splat, its colour where the file has colours, and all
/// attributes, with ranges and values. count is that of all splats. file must live as long as the columns' values.
PointOutline outlineOf(const ProFile& file);

/// Puts these splats of file in place of what block holds.
/// @param columns as outlineOf gives them, or some of them; attributes that file lacks are 0
void gatherPoints(const ProFile& file, std::span<const std::uint32_t> splats, std::span<const PointColumn> columns,
                  PointBlock& block);

} // namespace pointrt
