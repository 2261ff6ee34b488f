// SPDX-License-Identifier: Apache-2.0
#include "format/os/pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

namespace pointrt {

void* allocatePages(std::size_t alignment, std::size_t bytes) {
    void* const memory = std::aligned_alloc(alignment, bytes);
    if (memory && alignment == kHugePage) madvise(memory, bytes, MADV_HUGEPAGE); // optional, may fail
    return memory;
}

void freePages(void* memory) { std::free(memory); }

void dropPages(const void* start, std::size_t bytes) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t whole_pages = bytes / page * page;
    if (whole_pages > 0) madvise(const_cast<void*>(start), whole_pages, MADV_DONTNEED);
}

} // namespace pointrt
