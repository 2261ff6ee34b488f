// SPDX-License-Identifier: Apache-2.0
// Texel buffers of any size: split into pages if they exceed the largest texel buffer or allocation
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

/// A texel buffer of the bytes at data. On unified memory it imports the host's pages, which must then outlive it (see
/// importHostBuffer); otherwise it is a copy. Throws Error kCannotRun if out of memory, or if there are more texels
/// than the device supports in a buffer.
Buffer createTexelBuffer(Device& device, const char* what, const void* data, std::uint64_t bytes, VkFormat format);

/// The usage of texel buffers. Shaders read some as storage texel buffers, which every device supports for texels of
/// one or four words, or as storage buffers (shaders/lib/instance_bindings.glsl).
VkBufferUsageFlags texelUsage(VkFormat format);

/// Pages of 2^device.page_bits texels; the last may be shorter. Plain data: free it with destroyPagedBuffer, once.
struct PagedBuffer {
    std::vector<Buffer> pages; ///< 1 to MAX_PAGES, each with a view
};

/// createTexelBuffer for each page. Throws Error kCannotRun also if there are more than MAX_PAGES.
PagedBuffer createPagedBuffer(Device& device, const char* what, const void* data, std::uint64_t bytes, VkFormat format);
/// The same in device memory, uninitialised.
PagedBuffer createEmptyPagedBuffer(Device& device, const char* what, std::uint64_t bytes, VkFormat format);
/// Copies bytes from data to the buffer at offset, both multiples of the texel size. Not for imported buffers.
void uploadPages(Device& device, PagedBuffer& buffer, const void* data, std::uint64_t bytes, std::uint64_t offset);
void destroyPagedBuffer(Device& device, PagedBuffer& buffer);
/// Whether any page is imported memory.
bool isImported(const PagedBuffer& buffer);

/// For a buffer that may have pages: the binding of all pages but the first, in set SET_PAGES, and the specialization
/// constant for their number (shaders/lib/pages.glsl).
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

/// The page counts of an instance's buffers, in the order of kPagedPlaces.
struct PageCounts {
    std::uint32_t bits = 0; ///< log2 of the texels per page
    std::array<std::uint32_t, PAGED_BUFFERS> counts{};
    auto operator<=>(const PageCounts&) const = default;
};

/// Whether any buffer has more than one page, so that programs must be the paged variants.
bool isPaged(const PageCounts& pages);

using PagedBuffers = std::array<const PagedBuffer*, PAGED_BUFFERS>; ///< in the order of kPagedPlaces

PageCounts pageCounts(const Device& device, const PagedBuffers& buffers);
/// The specialization constants for programs that read paged buffers.
std::vector<SpecConstant> pageConstants(const PageCounts& pages);
/// The pages after the first of each buffer, for set SET_PAGES.
std::vector<BufferBinding> pageBindings(const PagedBuffers& buffers);

} // namespace pointrt
