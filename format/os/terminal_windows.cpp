// SPDX-License-Identifier: Apache-2.0
#include "format/os/terminal.h"

#include <io.h>

#include "format/os/descriptor.h"

namespace pointrt {

bool isTerminal(int descriptor) { return _isatty(descriptor) != 0; }

void printFromHandler(const char* text, std::size_t bytes) {
    // there is nowhere else to report a failure
    if (_write(kStandardError, text, static_cast<unsigned>(bytes)) < 0) return;
}

} // namespace pointrt
