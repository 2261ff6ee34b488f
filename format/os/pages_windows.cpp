// SPDX-License-Identifier: Apache-2.0
#include "format/os/pages.h"

#include "format/os/wide_path_windows.h"

#include <malloc.h>

namespace pointrt {

void* allocatePages(std::size_t alignment, std::size_t bytes) { return _aligned_malloc(bytes, alignment); }

void freePages(void* memory) { _aligned_free(memory); }

void dropPages(const void* start, std::size_t bytes) {
    // for pages that are not locked, this removes them from the working set
    VirtualUnlock(const_cast<void*>(start), bytes);
}

} // namespace pointrt
