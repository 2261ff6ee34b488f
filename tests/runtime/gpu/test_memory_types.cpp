// SPDX-License-Identifier: Apache-2.0
// The memory types chosen on devices as their drivers list them: Mesa's sources (radv_physical_device.c,
// anv_device.c, tu_device.cc, lvp_device.c), Intel's as Mesa's own tools print them, others as vulkan.gpuinfo.org
// shows them.
#include <gtest/gtest.h>

#include <initializer_list>
#include <ostream>

#include "runtime/gpu/memory_types.h"

namespace pointrt {
namespace {

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                kVisible = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT,
                                kCoherent = VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                                kCached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
                                kAmd = VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD |
                                       VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD;
constexpr VkMemoryPropertyFlags kCombined = kVisible | kCoherent; ///< write-combined
constexpr bool kDiscrete = false, kUnified = true;

struct DeviceTable {
    const char* name;
    bool unified;
    std::vector<VkMemoryPropertyFlags> types;
    std::uint32_t device, upload, readback; ///< the expected types
    bool maps_device;                       ///< whether the host may read device memory in place
    const char* reason;
};

void PrintTo(const DeviceTable& table, std::ostream* out) { *out << table.name; }

const DeviceTable kTables[] = {
    {"NVIDIA GTX 1060, 2018",
     kDiscrete,
     {0, 0, 0, 0, 0, 0, 0, kLocal, kLocal, kCombined, kCombined | kCached},
     7,
     9,
     10,
     false,
     "types without properties come first; the first local one is for buffers"},
    {"NVIDIA RTX 3060, 246 MiB of it visible",
     kDiscrete,
     {0, kLocal, kCombined, kCombined | kCached, kLocal | kCombined},
     1,
     2,
     3,
     false,
     "the visible window is small: buffers and uploads leave it alone"},
    {"NVIDIA RTX 4090, resizable BAR",
     kDiscrete,
     {0, kLocal, kCombined, kCombined | kCached, kLocal | kCombined},
     1,
     2,
     3,
     false,
     "reading through the bus is slow also where all memory is visible"},
    {"NVIDIA Tegra Orin",
     kUnified,
     {kLocal, kLocal | kCombined, kLocal | kCombined | kCached},
     2,
     1,
     2,
     true,
     "one memory, cached for the host"},
    {"AMD RX 6800 XT, RADV",
     kDiscrete,
     {kLocal, kCombined, kLocal | kCombined, kCombined | kCached},
     0,
     1,
     3,
     false,
     "uploads through the host's memory, not through the window"},
    {"AMD RX 7900 XTX, AMDVLK",
     kDiscrete,
     {kLocal, kLocal | kCombined, kCombined, kCombined | kCached, kLocal | kAmd, kLocal | kCombined | kAmd,
      kCombined | kAmd, kCombined | kCached | kAmd},
     0,
     2,
     3,
     false,
     "memory that the device does not cache is for debugging"},
    {"AMD Phoenix (APU), RADV",
     kUnified,
     {kLocal, kLocal | kCombined, kCombined, kCombined | kCached},
     0,
     1,
     3,
     false,
     "local memory is write-combined: the host reads copies in cached memory"},
    {"Intel Tiger Lake, anv",
     kUnified,
     {kLocal, kLocal | kCombined, kLocal | kCombined | kCached},
     2,
     1,
     2,
     true,
     "the last-level cache is shared: cached memory is as good for the device"},
    {"Intel Lunar Lake, anv",
     kUnified,
     {kLocal | kCombined, kLocal | kVisible | kCached},
     1,
     0,
     1,
     true,
     "cached memory is not coherent: flushed and invalidated"},
    {"Intel Arc A770, anv",
     kDiscrete,
     {kLocal, kCombined | kCached, kLocal | kCombined},
     0,
     1,
     1,
     false,
     "host memory is always cached"},
    {"Adreno 740, turnip",
     kUnified,
     {kLocal | kCombined, kLocal | kVisible | kCached | kCoherent},
     1,
     0,
     1,
     true,
     "the first type is write-combined"},
    {"Apple M2, MoltenVK",
     kUnified,
     {kLocal, kLocal | kCombined | kCached, kLocal | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT},
     1,
     1,
     1,
     true,
     "shared storage; memoryless is for attachments"},
    {"Mali G610, panvk",
     kUnified,
     {kLocal | kCombined},
     0,
     0,
     0,
     false,
     "no cached memory: what is read back is read slowly, all else stays on the device"},
    {"lavapipe", kUnified, {kLocal | kCombined | kCached}, 0, 0, 0, true, "the host's memory"},
};

VkPhysicalDeviceMemoryProperties memoryOf(const std::vector<VkMemoryPropertyFlags>& types) {
    VkPhysicalDeviceMemoryProperties memory{};
    for (const VkMemoryPropertyFlags flags : types) memory.memoryTypes[memory.memoryTypeCount++].propertyFlags = flags;
    return memory;
}

class MemoryTypes : public testing::TestWithParam<DeviceTable> {};
INSTANTIATE_TEST_SUITE_P(Devices, MemoryTypes, testing::ValuesIn(kTables));

TEST_P(MemoryTypes, SuitTheirUse) {
    const DeviceTable& table = GetParam();
    SCOPED_TRACE(table.reason);
    const VkPhysicalDeviceMemoryProperties memory = memoryOf(table.types);
    const auto choose = [&](MemoryHome home) { return chooseMemoryType(memory, ~0u, home, table.unified); };
    EXPECT_EQ(choose(MemoryHome::kDevice), table.device);
    EXPECT_EQ(choose(MemoryHome::kUpload), table.upload);
    EXPECT_EQ(choose(MemoryHome::kReadback), table.readback);
    EXPECT_EQ(isMapped(table.types[table.device], MemoryHome::kDevice, table.unified), table.maps_device);
    EXPECT_TRUE(isMapped(table.types[table.upload], MemoryHome::kUpload, table.unified));
    EXPECT_TRUE(isMapped(table.types[table.readback], MemoryHome::kReadback, table.unified));
}

TEST(MemoryTypesAllowed, AreTheOnlyOnesChosen) {
    const VkPhysicalDeviceMemoryProperties memory = memoryOf({kLocal, kCombined, kCombined | kCached});
    EXPECT_EQ(chooseMemoryType(memory, 0b110, MemoryHome::kDevice, kDiscrete), 1u) << "no local type is allowed";
    EXPECT_EQ(chooseMemoryType(memory, 0b011, MemoryHome::kReadback, kDiscrete), 1u) << "no cached type is allowed";
    EXPECT_FALSE(chooseMemoryType(memory, 0b001, MemoryHome::kUpload, kDiscrete));
    EXPECT_FALSE(chooseMemoryType(memory, 0, MemoryHome::kDevice, kDiscrete));
}

} // namespace
} // namespace pointrt
