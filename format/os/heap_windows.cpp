// SPDX-License-Identifier: Apache-2.0
#include "format/os/heap.h"

namespace pointrt {

void returnLargeBlocks() {} // does nothing: the heap of Windows returns large blocks anyway

} // namespace pointrt
