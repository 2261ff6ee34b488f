// SPDX-License-Identifier: Apache-2.0
// pointrt-rays measure: distances, angles, areas, volumes, circles and spheres.
#pragma once

#include "format/cli/command_text.h"

namespace pointrt {

/// @param argv from "measure" on
int measureCommand(int argc, const char* const* argv);

/// The text of --help, as data.
CommandText measureText();

} // namespace pointrt
