// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/memory_types.h"

#include <bit>

namespace pointrt {
namespace {

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                kVisible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT,
                                kCoherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
/// Memory types to avoid: not cached by the device, for protected submissions only, or for transient attachments.
constexpr VkMemoryPropertyFlags kUnusual = VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD |
                                           VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD |
                                           VK_MEMORY_PROPERTY_PROTECTED_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT;

struct Wish {
    VkMemoryPropertyFlags required = 0, preferred = 0, avoided = 0;
};

/// The type that fits a wish best; the first of several equally good ones, since drivers list faster types first.
std::optional<std::uint32_t> bestType(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                      const Wish& wish) {
    std::optional<std::uint32_t> best;
    int fewest = 0;
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags has = memory.memoryTypes[i].propertyFlags;
        if (!(allowed >> i & 1u) || (has & wish.required) != wish.required || (has & kUnusual)) continue;
        const int faults = std::popcount(wish.preferred & ~has) + std::popcount(wish.avoided & has);
        if (best && faults >= fewest) continue;
        best = i;
        fewest = faults;
    }
    return best;
}

} // namespace

std::optional<std::uint32_t> chooseMemoryType(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                                              MemoryHome home, bool unified) {
    const auto choose = [&](const Wish& wish) { return bestType(memory, allowed, wish); };
    // on graphics cards, the host-visible part may be a window of 256 MiB, and the rest of the memory is closer
    const VkMemoryPropertyFlags window = unified ? 0 : kLocal;
    std::optional<std::uint32_t> found;
    if (home == MemoryHome::kUpload) return choose({kVisible | kCoherent, 0, window});
    if (home == MemoryHome::kReadback) {
        found = choose({kVisible | kCached, kCoherent, window});
        return found ? found : choose({kVisible | kCoherent, 0, window});
    }
    if (unified) found = choose({kLocal | kVisible | kCached, kCoherent, 0});
    if (!found) found = choose({kLocal, 0, kVisible});
    return found ? found : choose({});
}

bool isMapped(VkMemoryPropertyFlags properties, MemoryHome home, bool unified) {
    if (!(properties & kVisible)) return false;
    return home != MemoryHome::kDevice || (unified && (properties & kCached) != 0);
}

} // namespace pointrt
