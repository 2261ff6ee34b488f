// SPDX-License-Identifier: Apache-2.0
// Buffers of any size for texel fetches: in pages, where one texel buffer or one allocation would not hold them
// (shaders/frame/pages.glsl).
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "shaders/shared/pages.h"

namespace pointrt {

/// Bytes as texels of format: where device and host share memory the host's own pages, which must stay then
/// (importHostBuffer says what that asks of them), else a copy. Throws Error kCannotRun: out of memory, or more than
/// the device reads in a texel buffer.
Buffer createTexelBuffer(Device& device, const char* what, const void* data, std::uint64_t bytes, VkFormat format);

/// Texels in pages of 2^device.page_bits, the last one shorter. Plain data: free it with destroyPagedBuffer, once.
struct PagedBuffer {
    std::vector<Buffer> pages; ///< 1 to MAX_PAGES, each with a view
};

/// createTexelBuffer for each page. Throws Error kCannotRun also where there are more than MAX_PAGES.
PagedBuffer createPagedBuffer(Device& device, const char* what, const void* data, std::uint64_t bytes, VkFormat format);
void destroyPagedBuffer(Device& device, PagedBuffer& buffer);
/// Whether any of the memory is the caller's.
bool isImported(const PagedBuffer& buffer);

/// The pages in use of an instance's buffers, as programs are specialized for them, in the order of
/// shaders/frame/pages.glsl.
struct PageCounts {
    std::uint32_t bits = 0; ///< log2 of a page's texels
    std::array<std::uint32_t, PAGED_BUFFERS> counts{};
    auto operator<=>(const PageCounts&) const = default;
};

/// Whether any buffer has more than one page, so that programs must be paged ones.
bool isPaged(const PageCounts& pages);

using PagedBuffers = std::array<const PagedBuffer*, PAGED_BUFFERS>; ///< in the order of shaders/frame/pages.glsl

PageCounts pageCounts(const Device& device, const PagedBuffers& buffers);
/// The pages after each one's first, at their places in set 1 (shaders/frame/pages.glsl).
std::vector<BufferBinding> pageBindings(const PagedBuffers& buffers);

} // namespace pointrt
