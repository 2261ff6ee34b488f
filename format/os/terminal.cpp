// SPDX-License-Identifier: Apache-2.0
#include "format/os/terminal.h"

#include <unistd.h>

namespace pointrt {

bool isTerminal(int descriptor) { return isatty(descriptor) == 1; }

void printFromHandler(const char* text, std::size_t bytes) {
    if (::write(STDERR_FILENO, text, bytes) < 0) return; // there is nowhere else to report a failure
}

} // namespace pointrt
