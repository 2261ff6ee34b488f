// SPDX-License-Identifier: GPL-3.0-or-later
// Names of coordinates in the headers of tables: "Easting", "pos_x [m]", "longitude".
#pragma once

#include <span>
#include <string>
#include <vector>

#include "preprocess/ingest/dimensions.h"

namespace pointrt {

/// If no column is named x, y or z, assigns that dimension to a column with another name for it: "pos_x", "Easting",
/// "E", "longitude", "Rechtswert" for x, and so on. dimensions, names: one per column. Returns whether x and y are
/// degrees of longitude and latitude.
bool findAxes(std::span<const std::string> names, std::span<Dimension> dimensions);

} // namespace pointrt
