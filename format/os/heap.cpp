// SPDX-License-Identifier: Apache-2.0
#include "format/os/heap.h"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace pointrt {

void returnLargeBlocks() {
#ifdef __GLIBC__
    // With smaller blocks, calls into the kernel would take more time than they save: at 1 MiB twice as much.
    constexpr int kLarge = 4 << 20;
    mallopt(M_MMAP_THRESHOLD, kLarge);
    mallopt(M_TRIM_THRESHOLD, 2 * kLarge); // glibc's own ratio
#endif
}

} // namespace pointrt
