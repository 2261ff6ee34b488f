// SPDX-License-Identifier: Apache-2.0
// pointrt-rays viewshed: which points observers see.
#pragma once

#include "format/cli/command_text.h"

namespace pointrt {

/// @param argv from "viewshed" on
int viewshedCommand(int argc, const char* const* argv);

/// The text of --help, as data.
CommandText viewshedText();

} // namespace pointrt
