// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/paged_buffer.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "format/base/error.h"
#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

void requireFewPages(const char* what, std::uint64_t bytes, std::uint64_t page_bytes) {
    const std::uint64_t pages = (bytes + page_bytes - 1) / page_bytes;
    if (pages > MAX_PAGES)
        throw Error{ExitCode::kCannotRun, std::string(what) + " of " + std::to_string(bytes) + " bytes needs " +
                                              std::to_string(pages) + " texel buffers on this device, the limit is " +
                                              std::to_string(MAX_PAGES)};
}

/// Calls make(start, bytes) for each page.
template <typename Make>
PagedBuffer pagesOf(Device& device, const char* what, std::uint64_t bytes, VkFormat format, const Make& make) {
    const std::uint64_t page_bytes = texelBytes(format) << device.page_bits;
    requireFewPages(what, bytes, page_bytes);
    PagedBuffer buffer;
    const OnError undo([&] { destroyPagedBuffer(device, buffer); });
    std::uint64_t start = 0;
    do {
        buffer.pages.push_back(make(start, std::min(page_bytes, bytes - start)));
        start += page_bytes;
    } while (start < bytes);
    return buffer;
}

} // namespace

VkBufferUsageFlags texelUsage(VkFormat format) {
    constexpr VkBufferUsageFlags kFetched =
        VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    return format == VK_FORMAT_R32G32_UINT ? kFetched : kFetched | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT;
}

Buffer createTexelBuffer(Device& device, const char* what, const void* data, std::uint64_t bytes, VkFormat format) {
    Buffer buffer;
    if (device.unified_memory) buffer = importHostBuffer(device, data, bytes, texelUsage(format));
    if (!buffer.handle) buffer = createFilledBuffer(device, what, data, bytes, texelUsage(format));
    createTexelView(device, what, buffer, format);
    return buffer;
}

PagedBuffer createPagedBuffer(Device& device, const char* what, const void* data, std::uint64_t bytes,
                              VkFormat format) {
    return pagesOf(device, what, bytes, format, [&](std::uint64_t start, std::uint64_t page_bytes) {
        return createTexelBuffer(device, what, static_cast<const std::byte*>(data) + start, page_bytes, format);
    });
}

PagedBuffer createEmptyPagedBuffer(Device& device, const char* what, std::uint64_t bytes, VkFormat format) {
    return pagesOf(device, what, bytes, format, [&](std::uint64_t, std::uint64_t page_bytes) {
        Buffer page = createBuffer(device, what, page_bytes, texelUsage(format));
        createTexelView(device, what, page, format);
        return page;
    });
}

void uploadPages(Device& device, PagedBuffer& buffer, const void* data, std::uint64_t bytes, std::uint64_t offset) {
    const auto* from = static_cast<const std::byte*>(data);
    for (Buffer& page : buffer.pages) {
        const std::uint64_t start = std::min(offset, page.bytes), there = std::min(bytes, page.bytes - start);
        if (there > 0) uploadBuffer(device, page, from, there, start);
        from += there;
        bytes -= there;
        offset -= start;
    }
}

bool isImported(const PagedBuffer& buffer) {
    return std::any_of(buffer.pages.begin(), buffer.pages.end(), [](const Buffer& page) { return page.imported; });
}

void destroyPagedBuffer(Device& device, PagedBuffer& buffer) {
    for (Buffer& page : buffer.pages) destroyBuffer(device, page);
    buffer = {};
}

bool isPaged(const PageCounts& pages) {
    return std::any_of(pages.counts.begin(), pages.counts.end(), [](std::uint32_t count) { return count > 1; });
}

PageCounts pageCounts(const Device& device, const PagedBuffers& buffers) {
    PageCounts pages{device.page_bits, {}};
    std::transform(buffers.begin(), buffers.end(), pages.counts.begin(),
                   [](const PagedBuffer* buffer) { return static_cast<std::uint32_t>(buffer->pages.size()); });
    return pages;
}

std::vector<SpecConstant> pageConstants(const PageCounts& pages) {
    std::vector<SpecConstant> constants{{SPEC_PAGE_BITS, pages.bits}};
    for (std::size_t k = 0; k < kPagedPlaces.size(); ++k) constants.push_back({kPagedPlaces[k].count, pages.counts[k]});
    return constants;
}

std::vector<BufferBinding> pageBindings(const PagedBuffers& buffers) {
    std::vector<BufferBinding> bindings;
    for (std::size_t k = 0; k < buffers.size(); ++k) {
        const std::vector<Buffer>& pages = buffers[k]->pages;
        // an array of bindings cannot be empty, even if it is not read
        const std::size_t first = pages.size() > 1 ? 1 : 0;
        bindings.push_back({kPagedPlaces[k].further, &pages[first], static_cast<std::uint32_t>(pages.size() - first)});
    }
    return bindings;
}

} // namespace pointrt
