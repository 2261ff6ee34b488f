// SPDX-License-Identifier: Apache-2.0
#include "format/os/environment.h"

#include <cstdlib>

namespace pointrt {

std::string environmentVariable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

} // namespace pointrt
