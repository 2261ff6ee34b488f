// SPDX-License-Identifier: GPL-3.0-or-later
// Names of coordinates in the headers of tables: "Easting", "pos_x [m]", "longitude".
#pragma once

#include <span>
#include <string>
#include <vector>

#include "preprocess/ingest/dimensions.h"

namespace pointrt {

/// Gives x, y and z that no column is named after to columns with other names of theirs: "pos_x", "Easting", "E",
/// "longitude", "Rechtswert" for x, and so on. dimensions, names: one per column.
/// Returns whether x and y are degrees of longitude and latitude.
bool findAxes(std::span<const std::string> names, std::span<Dimension> dimensions);

} // namespace pointrt
