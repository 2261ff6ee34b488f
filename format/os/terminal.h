// SPDX-License-Identifier: Apache-2.0
// Terminals.
#pragma once

#include <cstddef>

namespace pointrt {

/// Whether a descriptor, such as kStandardOutput, is a terminal.
bool isTerminal(int descriptor);

/// Writes text to standard error at once. May run in a signal handler.
void printFromHandler(const char* text, std::size_t bytes);

} // namespace pointrt
