// SPDX-License-Identifier: Apache-2.0
#include "runtime/trace/cast_slot.h"

#include "runtime/util/on_error.h"
#include "shaders/shared/params.h"

namespace pointrt {
namespace {

/// Texels in the host's memory, which all devices reach: each ray is read once, and each hit written once an instance.
Buffer hostTexels(Device& device, const char* what, std::uint64_t row_bytes, VkFormat format) {
    Buffer buffer = createBuffer(device, what, CastSlot::kRays * row_bytes, VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT,
                                 MemoryHome::kHost);
    createTexelView(device, what, buffer, format);
    return buffer;
}

/// What programs say of an instance, its buffers and the slot's.
DescriptorSets bind(CastSlot& slot, const DeviceScene& scene, const Instance& instance, const Program& program) {
    std::vector<BufferBinding> bindings = scanBindings(scene.files[instance.file]);
    bindings.insert(bindings.end(), {{BINDING_INSTANCE, &instance.params_buffer},
                                     {BINDING_CAST_RAYS, &slot.rays},
                                     {BINDING_CAST_HITS, &slot.hits},
                                     {BINDING_CAST_STOPPED, &slot.stopped}});
    const VkDescriptorSet common = createDescriptorSet(slot.device, slot.pool, program, bindings);
    if (!isPaged(scene.files[instance.file].pages)) return common;
    return {common, createDescriptorSet(slot.device, slot.pool, program, pageBindings(instancePages(scene, instance)),
                                        SET_PAGES)};
}

} // namespace

std::span<gpu::CastRay> CastSlot::rayRows(std::size_t count) {
    return {static_cast<gpu::CastRay*>(rays.mapped), count};
}
std::span<const gpu::CastHit> CastSlot::hitRows(std::size_t count) const {
    return {static_cast<const gpu::CastHit*>(hits.mapped), count};
}
std::span<const std::uint32_t> CastSlot::stoppedRows(std::size_t count) const {
    return {static_cast<const std::uint32_t*>(stopped.mapped), count};
}

CastSlot createSlot(Device& device, const DeviceScene& scene, const CastPrograms& programs) {
    CastSlot slot;
    const OnError undo([&] { destroySlot(slot); });
    slot.device = workerDevice(device);
    slot.starts.resize(CastSlot::kRays);
    slot.rays = hostTexels(slot.device, "ray buffer", sizeof(gpu::CastRay), VK_FORMAT_R32G32B32A32_UINT);
    slot.hits = hostTexels(slot.device, "hit buffer", sizeof(gpu::CastHit), VK_FORMAT_R32G32B32A32_UINT);
    slot.stopped = hostTexels(slot.device, "occlusion buffer", sizeof(std::uint32_t), VK_FORMAT_R32_UINT);
    slot.pool = createDescriptorPool(slot.device, 2 * static_cast<std::uint32_t>(scene.instances.size()));
    for (const Instance& instance : scene.instances)
        slot.sets.push_back(bind(slot, scene, instance, programs.at(traitsOf(scene, instance)).first_hit));
    return slot;
}

void destroySlot(CastSlot& slot) {
    if (!slot.device.handle) return;
    destroyDescriptorPool(slot.device, slot.pool);
    for (Buffer* buffer : {&slot.rays, &slot.hits, &slot.stopped}) destroyBuffer(slot.device, *buffer);
    destroyWorkerDevice(slot.device);
    slot = {};
}

void traceSlot(CastSlot& slot, const DeviceScene& scene, const CastPrograms& programs, std::size_t count,
               bool any_hit) {
    const auto rays = static_cast<std::uint32_t>(count);
    const VkCommandBuffer commands = beginCommands(slot.device);
    for (std::uint32_t place = 0; place < slot.sets.size(); ++place) {
        const CastPair& pair = programs.at(traitsOf(scene, scene.instances[place]));
        const gpu::CastPush push{rays, place, 0, 0};
        recordDispatch(commands, any_hit ? pair.any_hit : pair.first_hit, slot.sets[place], pushBytes(push),
                       {(rays + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE, 1, 1});
        recordBarrier(commands);
    }
    submitAndWait(slot.device, commands);
}

} // namespace pointrt
