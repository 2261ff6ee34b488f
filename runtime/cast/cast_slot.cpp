// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/cast_slot.h"

#include "runtime/util/on_error.h"
#include "shaders/shared/params.h"

namespace pointrt {
namespace {

/// Of a ray as callers have it: in doubles.
constexpr std::uint64_t kGivenBytes = 6 * sizeof(double);

/// Texels in the host's memory, which all devices reach: each ray is read once, and each hit written once.
Buffer hostTexels(Device& device, const char* what, std::uint64_t row_bytes, VkFormat format) {
    Buffer buffer =
        createBuffer(device, what, CastSlot::kRays * row_bytes,
                     VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryHome::kHost);
    createTexelView(device, what, buffer, format);
    return buffer;
}

/// Descriptor sets for so many runs; they go when it does.
struct SetPool {
    SetPool(Device& on, std::size_t runs)
        : device(on), handle(createDescriptorPool(on, 2 * static_cast<std::uint32_t>(runs))) {} // of some pages, too
    ~SetPool() { destroyDescriptorPool(device, handle); }
    SetPool(const SetPool&) = delete;
    SetPool& operator=(const SetPool&) = delete;
    Device& device;
    VkDescriptorPool handle;
};

GroupCount groupsOf(std::uint32_t rays) { return {(rays + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE, 1, 1}; }

/// The target's buffers, the slot's, and where the rays lie.
DescriptorSets bind(CastSlot& slot, const Buffer& rays, VkDescriptorPool pool, const PlacedTarget& target,
                    const Program& program) {
    std::vector<BufferBinding> bindings = scanBindings(*target.scan);
    bindings.insert(bindings.end(), {{BINDING_INSTANCE, &target.params},
                                     {BINDING_CAST_RAYS, &rays},
                                     {BINDING_CAST_HITS, &slot.hits},
                                     {BINDING_CAST_STOPPED, &slot.stopped}});
    const VkDescriptorSet common = createDescriptorSet(slot.device, pool, program, bindings);
    if (!isPaged(target.traits.pages)) return common;
    return {common,
            createDescriptorSet(slot.device, pool, program, pageBindings(pagedBuffers(*target.scan)), SET_PAGES)};
}

} // namespace

std::span<gpu::CastRay> CastSlot::rayRows(std::size_t count) {
    return {static_cast<gpu::CastRay*>(rays.mapped), count};
}
std::span<const gpu::CastHit> CastSlot::hitRows(std::size_t count) const {
    return {static_cast<const gpu::CastHit*>(hits.mapped), count};
}
std::span<const gpu::GivenHit> CastSlot::givenHits(std::size_t count) const {
    return {static_cast<const gpu::GivenHit*>(hits.mapped), count};
}
std::span<const std::uint32_t> CastSlot::stoppedRows(std::size_t count) const {
    return {static_cast<const std::uint32_t*>(stopped.mapped), count};
}

CastSlot createSlot(Device& device) {
    CastSlot slot;
    const OnError undo([&] { destroySlot(slot); });
    slot.device = workerDevice(device);
    slot.starts.resize(CastSlot::kRays);
    static_assert(sizeof(gpu::CastRay) <= kGivenBytes && sizeof(gpu::GivenHit) == sizeof(gpu::CastHit));
    slot.rays = hostTexels(slot.device, "ray buffer", kGivenBytes, VK_FORMAT_R32G32B32A32_UINT);
    slot.hits = hostTexels(slot.device, "hit buffer", sizeof(gpu::CastHit), VK_FORMAT_R32G32B32A32_UINT);
    slot.stopped = hostTexels(slot.device, "occlusion buffer", sizeof(std::uint32_t), VK_FORMAT_R32_UINT);
    return slot;
}

void destroySlot(CastSlot& slot) {
    if (!slot.device.handle) return;
    for (Buffer* buffer : {&slot.rays, &slot.hits, &slot.stopped}) destroyBuffer(slot.device, *buffer);
    destroyWorkerDevice(slot.device);
    slot = {};
}

void traceRows(CastSlot& slot, CastPrograms& programs, const PlacedTarget& target, const Buffer& rays, RayForm form,
               const gpu::GivenPush& push, bool any_hit) {
    const SetPool pool(slot.device, 1);
    const CastPair& pair = programs.of({target.traits, form});
    const VkCommandBuffer commands = beginCommands(slot.device);
    recordDispatch(commands, any_hit ? pair.any_hit : pair.first_hit,
                   bind(slot, rays, pool.handle, target, pair.first_hit), pushBytes(push), groupsOf(push.rays));
    recordBarrier(commands);
    submitAndWait(slot.device, commands);
}

void traceSlot(CastSlot& slot, CastPrograms& programs, std::span<const CastRun> runs, bool any_hit) {
    const SetPool pool(slot.device, runs.size());
    const VkCommandBuffer commands = beginCommands(slot.device);
    for (const CastRun& run : runs) { // they write to rows of their own: none waits for another
        const CastPair& pair = programs.of({run.target->traits, RayForm::kPacked});
        const gpu::CastPush push{run.count, run.first, 0, 0};
        recordDispatch(commands, any_hit ? pair.any_hit : pair.first_hit,
                       bind(slot, slot.rays, pool.handle, *run.target, pair.first_hit), pushBytes(push),
                       groupsOf(run.count));
    }
    recordBarrier(commands);
    submitAndWait(slot.device, commands);
}

} // namespace pointrt
