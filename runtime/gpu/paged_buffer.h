// SPDX-License-Identifier: Apache-2.0
// Buffers of any size for texel fetches: in pages, where one texel buffer or one allocation would not hold them
// (shaders/lib/pages.glsl).
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/gpu/program.h"
#include "runtime/gpu/resources.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/spec_constants.h"

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
/// The same, of memory of the device's own, without anything in it yet.
PagedBuffer createEmptyPagedBuffer(Device& device, const char* what, std::uint64_t bytes, VkFormat format);
/// Copies bytes from data to the buffer's at offset, both multiples of a texel's; not of imported memory.
void uploadPages(Device& device, PagedBuffer& buffer, const void* data, std::uint64_t bytes, std::uint64_t offset);
void destroyPagedBuffer(Device& device, PagedBuffer& buffer);
/// Whether any of the memory is the caller's.
bool isImported(const PagedBuffer& buffer);

/// Of a buffer that may have pages: where those after its first are bound, in set SET_PAGES, and the constant that says
/// how many there are (shaders/lib/pages.glsl).
struct PagedPlace {
    gpu::Binding further{};
    gpu::SpecId count{};
};
constexpr std::array<PagedPlace, PAGED_BUFFERS> kPagedPlaces{{{BINDING_BRICK_PAGES, SPEC_BRICK_PAGES},
                                                              {BINDING_CELL_PAGES, SPEC_CELL_PAGES},
                                                              {BINDING_SLAB_PAGES, SPEC_SLAB_PAGES},
                                                              {BINDING_NEAR_PAGES, SPEC_NEAR_PAGES},
                                                              {BINDING_LISTED_PAGES, SPEC_LISTED_PAGES},
                                                              {BINDING_BLENDING_PAGES, SPEC_BLENDING_PAGES},
                                                              {BINDING_SPLAT_PAGES, SPEC_SPLAT_PAGES}}};

/// The pages in use of an instance's buffers, in the order of kPagedPlaces.
struct PageCounts {
    std::uint32_t bits = 0; ///< log2 of a page's texels
    std::array<std::uint32_t, PAGED_BUFFERS> counts{};
    auto operator<=>(const PageCounts&) const = default;
};

/// Whether any buffer has more than one page, so that programs must be paged ones.
bool isPaged(const PageCounts& pages);

using PagedBuffers = std::array<const PagedBuffer*, PAGED_BUFFERS>; ///< in the order of kPagedPlaces

PageCounts pageCounts(const Device& device, const PagedBuffers& buffers);
/// What programs are specialized by for them.
std::vector<SpecConstant> pageConstants(const PageCounts& pages);
/// The pages after each one's first, at their places in set SET_PAGES.
std::vector<BufferBinding> pageBindings(const PagedBuffers& buffers);

} // namespace pointrt
