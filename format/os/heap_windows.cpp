// SPDX-License-Identifier: Apache-2.0
#include "format/os/heap.h"

namespace pointrt {

void returnLargeBlocks() {} // does nothing: its heap returns large blocks anyway

} // namespace pointrt
