// SPDX-License-Identifier: Apache-2.0
// pointrt-rays section: the lines in which planes cut surfaces.
#pragma once

#include "format/cli/command_text.h"

namespace pointrt {

/// @param argv from "section" on
int sectionCommand(int argc, const char* const* argv);

/// The text of --help, as data.
CommandText sectionText();

} // namespace pointrt
