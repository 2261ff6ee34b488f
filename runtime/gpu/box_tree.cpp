// SPDX-License-Identifier: Apache-2.0
#include "runtime/gpu/box_tree.h"

#include "runtime/util/on_error.h"

namespace pointrt {
namespace {

// Every device allows scratch memory that starts at multiples of this (minAccelerationStructureScratchOffsetAlignment).
constexpr VkDeviceAddress kScratchAlignment = 256;
constexpr VkBufferUsageFlags kInput =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

VkDeviceAddress addressOf(const Device& device, const Buffer& buffer) {
    VkBufferDeviceAddressInfo info{VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO};
    info.buffer = buffer.handle;
    return device.rays.addressOf(device.handle, &info);
}

VkAccelerationStructureGeometryKHR boxGeometry(const Device& device, const Buffer& boxes) {
    VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    geometry.geometryType = VK_GEOMETRY_TYPE_AABBS_KHR;
    geometry.geometry.aabbs = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR};
    geometry.geometry.aabbs.data.deviceAddress = addressOf(device, boxes);
    geometry.geometry.aabbs.stride = sizeof(VkAabbPositionsKHR);
    return geometry;
}

VkAccelerationStructureGeometryKHR instanceGeometry(const Device& device, const Buffer& instance) {
    VkAccelerationStructureGeometryKHR geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
    geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    geometry.geometry.instances = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
    geometry.geometry.instances.data.deviceAddress = addressOf(device, instance);
    return geometry;
}

/// The bottom level as an instance with the identity transform.
VkAccelerationStructureInstanceKHR instanceOf(const Device& device, const Buffer& bottom) {
    VkAccelerationStructureDeviceAddressInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
    info.accelerationStructure = bottom.tree;
    VkAccelerationStructureInstanceKHR instance{};
    for (int axis = 0; axis < 3; ++axis) instance.transform.matrix[axis][axis] = 1;
    instance.mask = 0xFF;
    instance.accelerationStructureReference = device.rays.addressOfTree(device.handle, &info);
    return instance;
}

/// A buffer with an acceleration structure of this size, not built yet.
Buffer createTree(Device& device, VkAccelerationStructureTypeKHR type, std::uint64_t bytes) {
    Buffer buffer = createBuffer(device, "acceleration structure", bytes,
                                 VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
                                     VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT);
    const OnError undo([&] { destroyBuffer(device, buffer); });
    VkAccelerationStructureCreateInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
    info.buffer = buffer.handle;
    info.size = bytes;
    info.type = type;
    check(device.rays.createTree(device.handle, &info, nullptr, &buffer.tree), "create an acceleration structure");
    return buffer;
}

/// A barrier between uploads, builds and programs that query.
void recordBuildBarrier(VkCommandBuffer commands) {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_ACCELERATION_STRUCTURE_WRITE_BIT_KHR;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR;
    vkCmdPipelineBarrier(commands,
                         VK_PIPELINE_STAGE_TRANSFER_BIT | VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR,
                         VK_PIPELINE_STAGE_ACCELERATION_STRUCTURE_BUILD_BIT_KHR | VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                         0, 1, &barrier, 0, nullptr, 0, nullptr);
}

/// Builds a level and waits.
Buffer buildLevel(Device& device, VkAccelerationStructureTypeKHR type,
                  const VkAccelerationStructureGeometryKHR& geometry, std::uint32_t count) {
    VkAccelerationStructureBuildGeometryInfoKHR info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
    info.type = type;
    info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    info.geometryCount = 1;
    info.pGeometries = &geometry;
    VkAccelerationStructureBuildSizesInfoKHR sizes{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
    device.rays.sizesOf(device.handle, VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &info, &count, &sizes);
    Buffer level = createTree(device, type, sizes.accelerationStructureSize);
    Buffer scratch;
    const OnError undo([&] {
        destroyBuffer(device, scratch);
        destroyBuffer(device, level);
    });
    scratch = createBuffer(device, "scratch buffer", sizes.buildScratchSize + kScratchAlignment,
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT);
    info.dstAccelerationStructure = level.tree;
    info.scratchData.deviceAddress =
        (addressOf(device, scratch) + kScratchAlignment - 1) / kScratchAlignment * kScratchAlignment;
    const VkAccelerationStructureBuildRangeInfoKHR range{count, 0, 0, 0};
    const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
    const VkCommandBuffer commands = beginCommands(device, "acceleration structure");
    recordBuildBarrier(commands);
    device.rays.build(commands, 1, &info, &ranges);
    recordBuildBarrier(commands);
    submitAndWait(device, commands);
    destroyBuffer(device, scratch);
    return level;
}

/// Builds a level from elements that only the build reads.
template <typename Element>
Buffer buildFrom(Device& device, VkAccelerationStructureTypeKHR type, std::span<const Element> elements,
                 VkAccelerationStructureGeometryKHR (*geometryOf)(const Device&, const Buffer&)) {
    Buffer input =
        createFilledBuffer(device, "acceleration structure input", elements.data(), elements.size_bytes(), kInput);
    const OnError undo([&] { destroyBuffer(device, input); });
    const Buffer level =
        buildLevel(device, type, geometryOf(device, input), static_cast<std::uint32_t>(elements.size()));
    destroyBuffer(device, input);
    return level;
}

} // namespace

BoxTree createBoxTree(Device& device, std::span<const VkAabbPositionsKHR> boxes) {
    BoxTree tree;
    const OnError undo([&] { destroyBoxTree(device, tree); });
    tree.bottom = buildFrom(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, boxes, boxGeometry);
    const VkAccelerationStructureInstanceKHR instance = instanceOf(device, tree.bottom);
    tree.top =
        buildFrom(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, std::span(&instance, 1), instanceGeometry);
    return tree;
}

void destroyBoxTree(Device& device, BoxTree& tree) {
    destroyBuffer(device, tree.top);
    destroyBuffer(device, tree.bottom);
}

} // namespace pointrt
