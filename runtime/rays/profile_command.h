// SPDX-License-Identifier: Apache-2.0
// pointrt-rays profile: the surface along a line.
#pragma once

#include "format/cli/command_text.h"

namespace pointrt {

/// @param argv from "profile" on
int profileCommand(int argc, const char* const* argv);

/// The text of --help, as data.
CommandText profileText();

} // namespace pointrt
