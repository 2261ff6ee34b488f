// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "format/base/error.h"
#include "format/base/parallel.h"
#include "runtime/cast/cast_programs.h"
#include "runtime/cast/cast_rounds.h"
#include "runtime/cast/describe_instances.h"
#include "runtime/cast/given_rays.h"
#include "runtime/cast/hit_unpacking.h"
#include "runtime/cast/scene_attributes.h"
#include "runtime/cast/slot_pool.h"
#include "runtime/cast/trace_device.h"
#include "runtime/cast/translated.h"
#include "runtime/util/vec_array.h"

namespace pointrt {
namespace {

/// At least two, so that packing overlaps tracing. A device that traces rays faster than one core packs them needs
/// more; beyond four, slots only take memory.
std::size_t slotCount() { return std::clamp(std::thread::hardware_concurrency(), 2u, 4u); }

/// Rays traced from instance to instance at a time; each takes 52 bytes. Larger batches reload tiles less often.
constexpr std::size_t kBatchRays = std::size_t{1} << 20;

std::vector<ClipDescription> clipsOf(const SceneOptions& options) {
    std::vector<ClipDescription> clips;
    for (const std::array<double, 6>& box : options.clips) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (!std::isfinite(box[axis + 3] - box[axis]) || !(box[axis] < box[axis + 3]))
                throw Error(ExitCode::kBadUsage,
                            "a clip box is MINX, MINY, MINZ, MAXX, MAXY, MAXZ, finite numbers with "
                            "each minimum below its maximum");
        clips.push_back(clipBox(box));
    }
    return clips;
}

std::vector<FilterDescription> filtersOf(const SceneOptions& options) {
    std::vector<FilterDescription> filters;
    for (const std::string& text : options.filters) {
        try {
            filters.push_back(parseFilter(text));
        } catch (const std::invalid_argument& reason) {
            throw Error(ExitCode::kBadUsage, std::string("only: ") + reason.what());
        }
    }
    return filters;
}

/// Reads the scene. With shapes, refuses more than 254 instances: the shapes take an instance number, too.
InstanceList described(const std::vector<std::string>& paths, const SceneOptions& options) {
    InstanceList list = describeInstances(paths, clipsOf(options), filtersOf(options));
    if (!list.shapes.empty() && list.scene_instances.size() >= kShapesInstance)
        throw Error(ExitCode::kBadUsage, "more than 254 instances in a scene with shapes");
    return list;
}

std::vector<Bounds> boxesOf(const InstanceList& list) {
    std::vector<Bounds> boxes;
    for (const CastInstance& each : list.instances) boxes.push_back(each.box);
    return boxes;
}

} // namespace

struct TraceScene::State {
    State(std::shared_ptr<TraceDevice::State> on, const std::vector<std::string>& paths, const SceneOptions& options)
        : owner(std::move(on)), device{workerDevice(owner->device)}, programs(device.worker),
          resident(device.worker, described(paths, options), options.memory), tree(boxesOf(resident.list())),
          slots(slotCount(), [this] { return createSlot(device.worker); }) {}

    /// Whether the scene is one instance, so that rays need not go from instance to instance.
    bool isOneInstance() const {
        return resident.isComplete() && resident.list().instances.size() == 1 && resident.list().shapes.empty();
    }

    /// Traces rays against the only instance chunk by chunk, one thread per slot: work(slot, first ray, count).
    template <typename Work>
    void inChunks(const CastRequest& request, const Work& work) {
        const std::size_t rays = request.rays.count, chunks = (rays + CastSlot::kRays - 1) / CastSlot::kRays;
        const ResidentInstance& instance = *resident.find(0);
        const auto trace = [&](CastSlot& slot, std::size_t first, std::size_t count) {
            packRays(instance.frame, request.rays, request.limits, first, slot.rayRows(count),
                     std::span(slot.starts).first(count));
            const CastRun run{&instance, 0, static_cast<std::uint32_t>(count)};
            traceSlot(slot, programs, {&run, 1}, request.any_hit);
            work(slot, first, count);
        };
        forAll(
            chunks,
            [&](std::size_t k) {
                const std::size_t first = k * CastSlot::kRays;
                slots.with([&](CastSlot& slot) { trace(slot, first, std::min(CastSlot::kRays, rays - first)); });
            },
            slots.most());
    }

    /// Traces the caller's rays, without packing, against the only instance chunk by chunk. Calls putAll(slot, first
    /// ray, count) for each chunk; if it returns false, put(ray, hit) for each ray of the chunk.
    template <typename PutAll, typename Put>
    void inGivenChunks(const CastRequest& request, const PutAll& putAll, const Put& put) {
        const std::size_t rays = request.rays.count, most = CastSlot::kRays;
        const ResidentInstance& instance = *resident.find(0);
        const GivenRays given(device.worker, request.rays);
        const auto trace = [&](CastSlot& slot, std::size_t first, std::size_t count) {
            given.trace(slot, programs, instance, request.limits, first, count, request.any_hit);
            return putAll(slot, first, count);
        };
        forAll((rays + most - 1) / most,
               [&](std::size_t k) {
                   const std::size_t first = k * most, count = std::min(most, rays - first);
                   bool done = false;
                   slots.with([&](CastSlot& slot) { done = trace(slot, first, count); });
                   // after the slot is released, since it takes slots itself
                   if (!done) castAndPut(request, first, count, put);
               },
               slots.most());
    }

    /// Traces rays from instance to instance batch by batch: work(ray, hit) for each, on all cores.
    template <typename Work>
    void inRounds(const CastRequest& request, const Work& work) {
        for (std::size_t first = 0; first < request.rays.count; first += kBatchRays)
            castAndPut(request, first, std::min(kBatchRays, request.rays.count - first), work);
    }

    template <typename Put>
    void castAndPut(const CastRequest& request, std::size_t first, std::size_t count, const Put& put) {
        const std::vector<RayHit> hits = castBatch(request, first, count);
        const std::size_t part = (count + slots.most() - 1) / slots.most();
        forAll((count + part - 1) / part, [&](std::size_t k) {
            for (std::size_t i = k * part; i < std::min(count, (k + 1) * part); ++i) put(first + i, hits[i]);
        });
    }

    std::vector<RayHit> castBatch(const CastRequest& request, std::size_t first, std::size_t count) {
        const std::unique_lock turn = takeTurn();
        return CastRounds({resident, tree, programs, slots}, request, first, count).run();
    }

    /// Locks the scene if tiles may be loaded and evicted.
    std::unique_lock<std::mutex> takeTurn() {
        return resident.isComplete() ? std::unique_lock<std::mutex>() : std::unique_lock(turns);
    }

    std::shared_ptr<TraceDevice::State> owner;
    struct Worker {
        Device worker;
        ~Worker() { destroyWorkerDevice(worker); }
    } device; // the members below are destroyed before it
    CastPrograms programs;
    InstanceResidency resident;
    InstanceTree tree;
    SlotPool slots;
    std::mutex turns;
};

TraceScene::TraceScene(const TraceDevice& device, const std::vector<std::string>& paths, const SceneOptions& options)
    : state_(translated([&] { return std::make_unique<State>(device.state_, paths, options); })) {}
TraceScene::~TraceScene() = default;
TraceScene::TraceScene(TraceScene&&) noexcept = default;
TraceScene& TraceScene::operator=(TraceScene&&) noexcept = default;

void TraceScene::castRays(RayRows rays, const RayLimits& limits, const HitArrays& hits) const {
    translated([&] {
        requireLimits(limits);
        requireSizes(hits, rays.count);
        const InstanceList& list = state_->resident.list();
        const CastRequest request{rays, limits, false};
        const auto put = [&](std::size_t ray, const RayHit& hit) { putHit(list, rays, ray, hit, hits); };
        if (!state_->isOneInstance()) return state_->inRounds(request, put);
        if (takesGiven(state_->device.worker, *state_->resident.find(0)))
            return state_->inGivenChunks(
                request,
                [&](CastSlot& slot, std::size_t first, std::size_t count) {
                    return putGiven(slot, list, rays, first, count, hits);
                },
                put);
        state_->inChunks(request, [&](CastSlot& slot, std::size_t first, std::size_t count) {
            const std::span<const gpu::CastHit> found = slot.hitRows(count);
            for (std::size_t i = 0; i < count; ++i)
                putHit(list, rays, first + i, hitOf(found[i], 0, slot.starts[i], limits, {}), hits);
        });
    });
}

void TraceScene::testOcclusions(RayRows rays, const RayLimits& limits, std::span<std::uint8_t> occluded) const {
    translated([&] {
        requireLimits(limits);
        if (occluded.size() != rays.count) throw Error(ExitCode::kBadUsage, "occluded must have one value per ray");
        const CastRequest request{rays, limits, true};
        const auto put = [&](std::size_t ray, const RayHit& hit) { occluded[ray] = hit.instance != kNothing; };
        if (!state_->isOneInstance()) return state_->inRounds(request, put);
        if (takesGiven(state_->device.worker, *state_->resident.find(0)))
            return state_->inGivenChunks(
                request,
                [&](CastSlot& slot, std::size_t first, std::size_t count) {
                    return putOccluded(slot, occluded.subspan(first, count));
                },
                put);
        state_->inChunks(request, [&](CastSlot& slot, std::size_t first, std::size_t count) {
            const std::span<const std::uint32_t> stopped = slot.occludedRows(count);
            for (std::size_t i = 0; i < count; ++i) occluded[first + i] = stopped[i] != 0;
        });
    });
}

std::vector<SceneAttribute> TraceScene::attributes() const { return sceneAttributes(state_->resident); }

void TraceScene::readAttribute(const std::string& name, std::span<const std::uint32_t> splat_ids,
                               std::span<const std::uint32_t> instance_ids, std::span<const std::uint32_t> tile_ids,
                               std::span<std::byte> values) const {
    translated([&] {
        const std::unique_lock turn = state_->takeTurn();
        gatherAttribute(state_->resident, name, {splat_ids, instance_ids, tile_ids}, values);
    });
}

void TraceScene::readAttribute(const std::string& name, std::span<const std::uint32_t> splat_ids,
                               std::span<const std::uint32_t> instance_ids, std::span<std::byte> values) const {
    readAttribute(name, splat_ids, instance_ids, {}, values);
}

void TraceScene::readColors(std::span<const std::uint32_t> splat_ids, std::span<const std::uint32_t> instance_ids,
                            std::span<const std::uint32_t> tile_ids, std::span<std::uint8_t> colors) const {
    translated([&] {
        const std::unique_lock turn = state_->takeTurn();
        gatherColors(state_->resident, {splat_ids, instance_ids, tile_ids}, colors);
    });
}

void TraceScene::readColors(std::span<const std::uint32_t> splat_ids, std::span<const std::uint32_t> instance_ids,
                            std::span<std::uint8_t> colors) const {
    readColors(splat_ids, instance_ids, {}, colors);
}

SceneBounds TraceScene::bounds() const {
    const std::vector<CastInstance>& instances = state_->resident.list().instances;
    if (instances.empty()) return {};
    SceneBounds bounds{arrayOf(instances[0].box.lo), arrayOf(instances[0].box.hi)};
    for (const CastInstance& instance : instances)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            bounds.low[axis] = std::min(bounds.low[axis], arrayOf(instance.box.lo)[axis]);
            bounds.high[axis] = std::max(bounds.high[axis], arrayOf(instance.box.hi)[axis]);
        }
    return bounds;
}

double TraceScene::metresPerUnit() const { return pointrt::metresPerUnit(state_->resident); }
std::uint64_t TraceScene::splatCount() const { return pointrt::splatCount(state_->resident); }
std::size_t TraceScene::instanceCount() const { return state_->resident.list().scene_instances.size(); }
bool TraceScene::hasTiles() const { return !state_->resident.list().sets.empty(); }
std::uint64_t TraceScene::tileLoads() const { return state_->resident.tileLoads(); }
std::uint64_t TraceScene::deviceBytes() const { return state_->resident.deviceBytes(); }

} // namespace pointrt
