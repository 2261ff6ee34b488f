// SPDX-License-Identifier: Apache-2.0
#include <cerrno>

#include "format/os/swap_names.h"

namespace pointrt {

bool swapNames(const std::string&, const std::string&) {
    errno = ENOSYS;
    return false;
}

} // namespace pointrt
