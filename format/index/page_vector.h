// SPDX-License-Identifier: Apache-2.0
// Vectors in page-aligned memory, which devices can import (importHostBuffer in runtime/gpu).
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "format/os/pages.h"

namespace pointrt {

/// Large vectors use huge pages: fewer page faults, and the alignment that drivers need for imports.
template <typename T>
struct PageAllocator {
    using value_type = T;
    static constexpr std::size_t kPage = std::size_t{64} << 10;

    PageAllocator() = default;
    template <typename U>
    PageAllocator(const PageAllocator<U>&) {}

    T* allocate(std::size_t count) {
        const std::size_t page = count * sizeof(T) >= kHugePage ? kHugePage : kPage;
        const std::size_t bytes = (count * sizeof(T) + page - 1) / page * page;
        void* memory = allocatePages(page, bytes);
        if (!memory) throw std::bad_alloc();
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) { freePages(memory); }

    friend bool operator==(const PageAllocator&, const PageAllocator&) { return true; }
};

using Words = std::vector<std::uint32_t, PageAllocator<std::uint32_t>>;

} // namespace pointrt
