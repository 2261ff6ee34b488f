// SPDX-License-Identifier: Apache-2.0
// pointrt-rays contours: lines of equal height.
#pragma once

#include "format/cli/command_text.h"

namespace pointrt {

/// @param argv from "contours" on
int contoursCommand(int argc, const char* const* argv);

/// The text of --help, as data.
CommandText contoursText();

} // namespace pointrt
