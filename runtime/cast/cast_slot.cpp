// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/cast_slot.h"

#include "runtime/util/on_error.h"
#include "shaders/shared/params.h"

namespace pointrt {
namespace {

/// Bytes of a caller's ray, in doubles.
constexpr std::uint64_t kGivenBytes = 6 * sizeof(double);

/// Texels in host memory, which all devices can access: each ray is read once and each hit written once.
Buffer hostTexels(Device& device, const char* what, std::uint64_t row_bytes, VkFormat format, MemoryHome home) {
    Buffer buffer = createBuffer(device, what, CastSlot::kRays * row_bytes,
                                 VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, home);
    createTexelView(device, what, buffer, format);
    return buffer;
}

/// A descriptor pool with sets for a number of runs.
struct SetPool {
    SetPool(Device& on, std::size_t runs)
        : device(on), handle(createDescriptorPool(on, 2 * static_cast<std::uint32_t>(runs))) {
    } // the second set is for further pages
    ~SetPool() { destroyDescriptorPool(device, handle); }
    SetPool(const SetPool&) = delete;
    SetPool& operator=(const SetPool&) = delete;
    Device& device;
    VkDescriptorPool handle;
};

GroupCount groupsOf(std::uint32_t rays) { return {(rays + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE, 1, 1}; }

/// Binds the buffers of the instance and of the slot, and the rays.
DescriptorSets bind(CastSlot& slot, const Buffer& rays, VkDescriptorPool pool, const ResidentInstance& instance,
                    const Program& program) {
    const DeviceScan& scan = *instance.scan;
    std::vector<BufferBinding> bindings =
        instance.painted ? paintedBindings(scan, *instance.painted) : scanBindings(scan);
    bindings.insert(bindings.end(), {{BINDING_INSTANCE, &instance.params},
                                     {BINDING_CAST_RAYS, &rays},
                                     {BINDING_CAST_HITS, &slot.hits},
                                     {BINDING_CAST_STOPPED, &slot.occluded}});
    const VkDescriptorSet common = createDescriptorSet(slot.device, pool, program, bindings);
    if (!isPaged(instance.traits.pages)) return common;
    const PagedBuffers pages = instance.painted ? paintedPages(scan, *instance.painted) : pagedBuffers(scan);
    return {common, createDescriptorSet(slot.device, pool, program, pageBindings(pages), SET_PAGES)};
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
std::span<const std::uint32_t> CastSlot::occludedRows(std::size_t count) const {
    return {static_cast<const std::uint32_t*>(occluded.mapped), count};
}

CastSlot createSlot(Device& device) {
    CastSlot slot;
    const OnError undo([&] { destroySlot(slot); });
    slot.device = workerDevice(device);
    slot.starts.resize(CastSlot::kRays);
    static_assert(sizeof(gpu::CastRay) <= kGivenBytes && sizeof(gpu::GivenHit) == sizeof(gpu::CastHit));
    slot.rays = hostTexels(slot.device, "ray buffer", kGivenBytes, VK_FORMAT_R32G32B32A32_UINT, MemoryHome::kUpload);
    slot.hits =
        hostTexels(slot.device, "hit buffer", sizeof(gpu::CastHit), VK_FORMAT_R32G32B32A32_UINT, MemoryHome::kReadback);
    slot.occluded =
        hostTexels(slot.device, "occlusion buffer", sizeof(std::uint32_t), VK_FORMAT_R32_UINT, MemoryHome::kReadback);
    return slot;
}

void destroySlot(CastSlot& slot) {
    if (!slot.device.handle) return;
    for (Buffer* buffer : {&slot.rays, &slot.hits, &slot.occluded}) destroyBuffer(slot.device, *buffer);
    destroyWorkerDevice(slot.device);
    slot = {};
}

void traceRows(CastSlot& slot, CastPrograms& programs, const ResidentInstance& instance, const Buffer& rays,
               RayForm form, const gpu::GivenPush& push, bool any_hit) {
    const SetPool pool(slot.device, 1);
    const CastPair& pair = programs.of({instance.traits, form});
    const VkCommandBuffer commands = beginCommands(slot.device, "cast rays");
    recordDispatch(commands, any_hit ? pair.any_hit : pair.first_hit,
                   bind(slot, rays, pool.handle, instance, pair.first_hit), pushBytes(push), groupsOf(push.rays));
    recordBarrier(commands);
    submitAndWait(slot.device, commands);
    hostBytes(slot.device, any_hit ? slot.occluded : slot.hits);
}

void traceSlot(CastSlot& slot, CastPrograms& programs, std::span<const CastRun> runs, bool any_hit) {
    const SetPool pool(slot.device, runs.size());
    const VkCommandBuffer commands = beginCommands(slot.device, "cast rays");
    for (const CastRun& run : runs) { // each run writes its own rows, so no barriers are needed
        const CastPair& pair = programs.of({run.instance->traits, RayForm::kPacked});
        const gpu::CastPush push{run.count, run.first, 0, 0};
        recordDispatch(commands, any_hit ? pair.any_hit : pair.first_hit,
                       bind(slot, slot.rays, pool.handle, *run.instance, pair.first_hit), pushBytes(push),
                       groupsOf(run.count));
    }
    recordBarrier(commands);
    submitAndWait(slot.device, commands);
    hostBytes(slot.device, any_hit ? slot.occluded : slot.hits);
}

} // namespace pointrt
