// SPDX-License-Identifier: Apache-2.0
// pointrt-rays sun: hours of direct sun on points, and how much of the sky they see.
#pragma once

#include "format/cli/command_text.h"

namespace pointrt {

/// @param argv from "sun" on
int sunCommand(int argc, const char* const* argv);

/// The text of --help, as data.
CommandText sunText();

} // namespace pointrt
