// SPDX-License-Identifier: Apache-2.0
// pointrt-rays compare: signed distances between two scans.
#pragma once

#include "format/cli/command_text.h"

namespace pointrt {

/// @param argv from "compare" on
int compareCommand(int argc, const char* const* argv);

/// The text of --help, as data.
CommandText compareText();

} // namespace pointrt
