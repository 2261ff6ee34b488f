// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "format/base/error.h"
#include "format/base/parallel.h"
#include "format/set/tile_set.h"
#include "runtime/device_scene/device_scene.h"
#include "runtime/trace/cast_programs.h"
#include "runtime/trace/hit_unpacking.h"
#include "runtime/trace/scene_attributes.h"
#include "runtime/trace/slot_pool.h"
#include "runtime/trace/trace_device.h"
#include "runtime/trace/translated.h"
#include "runtime/tracer/frame_params.h"

namespace pointrt {
namespace {

/// More than two keep a device at work whose rays take less time than packing them on one core; beyond four, memory is
/// all that they take.
std::size_t slotCount() { return std::clamp(std::thread::hardware_concurrency(), 2u, 4u); }

/// Says no to what would be read as something else. Files that are missing, or no .pro, are told by who opens them.
void requireScan(const std::string& path) {
    const char* kind = isTileSet(path) ? "a tile set" : path.ends_with(".toml") ? "a scene file" : nullptr;
    if (kind)
        throw Error(ExitCode::kBadInput,
                    path + ": is " + kind + "; rays are cast through .pro files, one or several of them");
}

SceneDescription describe(const std::vector<std::string>& paths) {
    if (paths.empty()) throw Error(ExitCode::kBadUsage, "a scene needs at least one .pro file");
    SceneDescription description;
    for (const std::string& path : paths) {
        requireScan(path);
        description.instances.push_back({path, {}, {}, {}});
    }
    return description;
}

/// Around all that the scene's rays can hit.
RayFrame frameOf(const DeviceScene& scene) {
    gpu::FrameParams params{};
    setReach(scene, params);
    return {scene.space,
            {params.reach_low.x, params.reach_low.y, params.reach_low.z},
            {params.reach_high.x, params.reach_high.y, params.reach_high.z}};
}

} // namespace

struct TraceScene::State {
    State(std::shared_ptr<TraceDevice::State> on, const std::vector<std::string>& paths)
        : owner(std::move(on)), device(workerDevice(owner->device)) {
        try {
            open(describe(paths));
        } catch (...) {
            destroy();
            throw;
        }
    }
    ~State() { destroy(); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    /// Chunk by chunk, on as many threads as there are slots: work(slot, first ray, count).
    template <typename Work>
    void inChunks(std::size_t rays, const Work& work) {
        const std::size_t chunks = (rays + CastSlot::kRays - 1) / CastSlot::kRays;
        forAll(
            chunks,
            [&](std::size_t k) {
                const std::size_t first = k * CastSlot::kRays;
                slots->with([&](CastSlot& slot) { work(slot, first, std::min(CastSlot::kRays, rays - first)); });
            },
            slots->most());
    }

    void trace(CastSlot& slot, const RayRows& rays, const RayLimits& limits, std::size_t first, std::size_t count,
               bool any_hit) const {
        packRays(frame, rays, limits, first, slot.rayRows(count), slot.starts);
        traceSlot(slot, scene, programs, count, any_hit);
    }

    std::shared_ptr<TraceDevice::State> owner;
    Device device; ///< a worker of the owner's
    DeviceScene scene;
    CastPrograms programs;
    RayFrame frame;
    std::vector<std::uint32_t> instances; ///< numbers, by their places on the device
    std::optional<SlotPool> slots;

private:
    void open(SceneDescription description) {
        scene = openScene(device, std::move(description), false);
        for (Instance& instance : scene.instances) {
            uploadBuffer(device, instance.params_buffer, &instance.params, sizeof instance.params);
            instances.push_back(instance.number);
        }
        programs = createCastPrograms(device, scene);
        frame = frameOf(scene);
        slots.emplace(slotCount(), [this] { return createSlot(device, scene, programs); });
    }

    void destroy() {
        slots.reset();
        destroyCastPrograms(device, programs);
        destroyDeviceScene(device, scene);
        destroyWorkerDevice(device);
    }
};

TraceScene::TraceScene(const TraceDevice& device, const std::vector<std::string>& paths)
    : state_(translated([&] { return std::make_unique<State>(device.state_, paths); })) {}
TraceScene::~TraceScene() = default;
TraceScene::TraceScene(TraceScene&&) noexcept = default;
TraceScene& TraceScene::operator=(TraceScene&&) noexcept = default;

void TraceScene::castRays(RayRows rays, const RayLimits& limits, const HitArrays& hits) const {
    translated([&] {
        requireLimits(limits);
        requireSizes(hits, rays.count);
        state_->inChunks(rays.count, [&](CastSlot& slot, std::size_t first, std::size_t count) {
            state_->trace(slot, rays, limits, first, count, false);
            unpackHits({first, slot.hitRows(count), slot.starts, state_->instances}, rays, limits, hits);
        });
    });
}

void TraceScene::testOcclusions(RayRows rays, const RayLimits& limits, std::span<std::uint8_t> occluded) const {
    translated([&] {
        requireLimits(limits);
        if (occluded.size() != rays.count) throw Error(ExitCode::kBadUsage, "occluded must have a number for each ray");
        state_->inChunks(rays.count, [&](CastSlot& slot, std::size_t first, std::size_t count) {
            state_->trace(slot, rays, limits, first, count, true);
            const std::span<const std::uint32_t> stopped = slot.stoppedRows(count);
            for (std::size_t i = 0; i < count; ++i) occluded[first + i] = stopped[i] != 0;
        });
    });
}

std::vector<SceneAttribute> TraceScene::attributes() const { return sceneAttributes(state_->scene); }

void TraceScene::readAttribute(const std::string& name, std::span<const std::uint32_t> splat_ids,
                               std::span<const std::uint32_t> instance_ids, std::span<std::byte> values) const {
    translated([&] { gatherAttribute(state_->scene, name, splat_ids, instance_ids, values); });
}

void TraceScene::readColors(std::span<const std::uint32_t> splat_ids, std::span<const std::uint32_t> instance_ids,
                            std::span<std::uint8_t> colors) const {
    translated([&] { gatherColors(state_->scene, splat_ids, instance_ids, colors); });
}

double TraceScene::metresPerUnit() const { return pointrt::metresPerUnit(state_->scene); }
std::uint64_t TraceScene::splatCount() const { return state_->scene.splat_count; }
std::uint64_t TraceScene::deviceBytes() const { return state_->scene.device_bytes; }

} // namespace pointrt
