// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/caustics.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <future>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/render/frame_buffers.h"
#include "runtime/render/frame_params.h"
#include "runtime/render/instance_culling.h"
#include "runtime/render/map_schedule.h"
#include "runtime/render/photon_emission.h"
#include "runtime/render/traced_instances.h"
#include "runtime/scene/layers.h"
#include "runtime/util/on_error.h"
#include "shaders/shared/groups_for.h"

namespace pointrt {

namespace {

/// Photons of a batch, traced as a band of pixels.
constexpr std::uint32_t kBatchWidth = 512, kBatchRows = 256;
constexpr std::uint32_t kBatch = kBatchWidth * kBatchRows;
/// Most mirror and glass bounces of a photon; little light is left after these.
constexpr std::uint32_t kPhotonBounces = 16;
/// Each batch takes passes for each instance: scenes with more instances than this get fewer photons, to keep the time
/// about the same.
constexpr std::size_t kInstancesForAll = 8;

RenderSphere sphereAround(const RenderSpace& space, const Bounds& bounds) {
    const Vec3 lo = renderPoint(space, bounds.lo), hi = renderPoint(space, bounds.hi);
    return {0.5 * (lo + hi), 0.5 * length(hi - lo)};
}

/// The scene's radius in render units; if the scans are a single point, 1, the edge of the scan's cube.
double radiusOf(const DeviceScene& scene) {
    const double radius = sphereAround(scene.space, scene.bounds).radius;
    return radius > 0 ? radius : 1;
}

/// Bounds including all shapes that may block the sun, except infinite planes.
Bounds boundsWithShapes(const DeviceScene& scene) {
    const std::optional<Bounds> shapes = boundsOfShapes(scene.description);
    return shapes ? joined(scene.bounds, *shapes) : scene.bounds;
}

/// A bounding sphere of the shape. Its transform is a similarity unless its edges differ. row: the shape on the device.
PhotonTarget shapeTarget(const DeviceScene& scene, const ShapeDescription& shape, std::size_t row) {
    const bool round = shape.kind == ShapeKind::kSphere || shape.kind == ShapeKind::kDisc;
    const bool flat = shape.kind == ShapeKind::kQuad;
    const double uu = dot(shape.u, shape.u), vv = dot(shape.v, shape.v), ww = dot(shape.w, shape.w);
    const double squared = round ? std::max(uu, vv) : uu + vv + (flat ? 0 : ww);
    return {renderPoint(scene.space, shape.center), std::sqrt(squared) / scene.space.scale,
            OWNER_SHAPES | static_cast<std::uint32_t>(row) << PHOTON_SHAPE_SHIFT};
}

std::vector<PhotonTarget> findTargets(const DeviceScene& scene) {
    std::vector<PhotonTarget> targets;
    const std::vector<const DeviceScan*> scans = representativeScans(scene);
    const auto casts = [&](std::uint32_t number) {
        return std::any_of(scene.instances.begin(), scene.instances.end(),
                           [&](const Instance& each) { return each.number == number && each.params.materials.w != 0; });
    };
    for (std::uint32_t i = 0; i < scans.size(); ++i) {
        if (!casts(i)) continue;
        const Bounds bounds = placedBounds(scene.description.instances[i].placement, scans[i]->info);
        const RenderSphere around = sphereAround(scene.space, bounds);
        targets.push_back({around.center, around.radius, i});
    }
    const std::vector<std::size_t> shown = shownShapes(scene.description);
    for (std::size_t row = 0; row < shown.size(); ++row)
        if (scene.casting_shapes[row]) targets.push_back(shapeTarget(scene, scene.description.shapes[shown[row]], row));
    return targets;
}

/// The tracer's programs over photons, a batch at a time.
class PhotonTracer {
public:
    PhotonTracer(Device& device, const DeviceScene& scene, const Programs& programs, std::uint32_t seed)
        : device_(device), scene_(scene), programs_(programs) {
        const OnError undo([&] { release(); });
        buffers_ = createFrameBuffers(device, kBatch, {kBatch}, mayCull(scene), GaussianRoom::kNone);
        map_ = emptyCaustics(device);
        destroyBuffer(device, map_.traced);
        map_.traced = createBuffer(device, "traced photon buffer", kBatch * sizeof(gpu::Photon),
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        bindAll(seed);
    }
    PhotonTracer(const PhotonTracer&) = delete;
    PhotonTracer& operator=(const PhotonTracer&) = delete;
    ~PhotonTracer() { release(); }

    /// Starts 1 to kBatch paths, with random numbers that no other batch uses.
    void begin(const std::vector<gpu::PathState>& paths, std::uint32_t batch) {
        batch_ = batch;
        pass_ = 1;
        std::vector<gpu::Photon> none(paths.size());
        uploadBuffer(device_, map_.traced, none.data(), none.size() * sizeof none[0]);
        uploadBuffer(device_, buffers_.paths, paths.data(), paths.size() * sizeof paths[0]);
        std::vector<std::uint32_t> queue(paths.size());
        std::iota(queue.begin(), queue.end(), 0u);
        // pass 1 reads from queue 1
        uploadBuffer(device_, buffers_.queues, queue.data(), queue.size() * sizeof queue[0], kBatch * sizeof queue[0]);
        gpu::Control control{};
        control.queued[1] = count_ = static_cast<std::uint32_t>(paths.size());
        control.ray_groups = gpu::groupsFor(count_);
        control.hit_groups = gpu::groupsFor(0); // programs that append hits set only x
        uploadBuffer(device_, buffers_.control, &control, sizeof control);
    }

    /// Traces photons to their next hits, in a separate submission, so that a window sharing the queue can draw in
    /// between. False once no photon of the batch is in flight.
    bool pass() {
        PassCommands commands(device_, buffers_.control, {buffers_.control_read}, nullptr);
        record(commands, pass_++);
        commands.endSample();
        const gpu::Control control = commands.finish().front();
        return pass_ <= kPhotonBounces + 1 && control.queued[0] + control.queued[1] > 0;
    }

    /// Appends the stored photons of the batch.
    void collect(std::vector<gpu::Photon>& stored) const {
        std::vector<gpu::Photon> traced(count_);
        downloadBuffer(device_, map_.traced, traced.data(), traced.size() * sizeof traced[0]);
        std::copy_if(traced.begin(), traced.end(), std::back_inserter(stored),
                     [](const gpu::Photon& photon) { return photon.flux.w > 0; });
    }

private:
    void release() {
        destroyTracedInstances(device_, instances_);
        destroyFrameBuffers(device_, buffers_);
        destroyCaustics(device_, map_);
    }

    void bindAll(std::uint32_t seed) {
        instances_ = bindTracedInstances(device_, programs_, scene_, buffers_, map_);
        gpu::FrameParams params{};
        params.width = kBatchWidth;
        params.height = params.rows = kBatchRows;
        params.options = OPTION_BLEND;
        setShapes(scene_, params);
        params.sky_light = NO_LIGHT;
        params.integrator = static_cast<std::uint32_t>(Integrator::kPath);
        params.bounces = kPhotonBounces;
        params.seed = seed;
        setInstanceBounds(scene_, params);
        uploadBuffer(device_, buffers_.params, &params, sizeof params);
    }

    void record(PassCommands& commands, std::uint32_t pass) {
        const gpu::PushParams push{batch_, 0, pass % 2 ? STEP_QUEUE_ONE : 0u, LIST_INSTANCE_RAYS};
        const PassLanes queue = pass % 2 ? PassLanes::kQueueOne : PassLanes::kQueueZero;
        const auto prepare = [&](std::uint32_t bits) {
            gpu::PushParams step = push;
            step.step |= bits;
            commands.run({programs_.prepare, instances_.sets, pushBytes(step), PassLanes::kOne, 1});
        };
        commands.run({programs_.queued.intersect_shapes, instances_.sets, pushBytes(push), queue});
        prepare(STEP_LIST);
        bool is_first = true;
        const InstanceRayList rays{LIST_INSTANCE_RAYS, &CullPrograms::closest, push};
        intersectInstances(commands, programs_, instances_, rays, [&](const TracedInstance& each, std::uint32_t list) {
            if (!std::exchange(is_first, false)) prepare(STEP_HITS);
            gpu::PushParams of_list = push;
            of_list.list = list;
            commands.run({each.programs->intersect_closest, each.sets, pushBytes(of_list), PassLanes::kList, 0, list});
            commands.run({each.programs->surface, each.sets, pushBytes(push), PassLanes::kHits});
        });
        commands.run({programs_.photon, instances_.sets, pushBytes(push), queue});
        prepare(0);
    }

    Device& device_;
    const DeviceScene& scene_;
    const Programs& programs_;
    CausticMap map_; ///< empty except for the photons in flight
    FrameBuffers buffers_;
    TracedInstances instances_;
    std::uint32_t batch_ = 0, pass_ = 0, count_ = 0;
};

PhotonEmission emissionOf(const DeviceScene& scene, const CausticOrder& order) {
    const auto count = order.count / static_cast<std::uint32_t>(1 + scene.instances.size() / kInstancesForAll);
    return {scene.light_rows,
            findTargets(scene),
            sphereAround(scene.space, boundsWithShapes(scene)),
            count,
            {order.map, order.seed}};
}

} // namespace

struct CausticJob::State {
    State(Device& owner, const DeviceScene& scene, const CausticOrder& wanted)
        : device(owner), order(wanted), scene_radius(radiusOf(scene)), emission(emissionOf(scene, wanted)) {}

    Device& device;
    CausticOrder order;
    double scene_radius;
    PhotonEmission emission;
    std::optional<PhotonTracer> tracer; ///< until all photons have been traced
    std::uint32_t batch = 0;            ///< number of the next batch, over all maps
    bool in_flight = false;
    std::vector<gpu::Photon> stored;
    std::future<PhotonMap> sorted; ///< sorted on its own thread, as that takes a while
};

CausticJob::CausticJob(Device& device, const DeviceScene& scene, const Programs& programs, const CausticOrder& order)
    : state_(std::make_unique<State>(device, scene, order)) {
    const auto batches = static_cast<std::uint32_t>((state_->emission.count() + kBatch - 1) / kBatch);
    state_->batch = order.map * batches;
    if (batches > 0) state_->tracer.emplace(device, scene, programs, order.seed);
}

CausticJob::~CausticJob() = default;

std::uint32_t CausticJob::map() const { return state_->order.map; }

bool CausticJob::step() {
    State& state = *state_;
    constexpr std::chrono::milliseconds kStep{5};
    if (state.sorted.valid()) return state.sorted.wait_for(kStep) != std::future_status::ready;
    if (state.in_flight) {
        state.in_flight = state.tracer->pass();
        if (!state.in_flight) state.tracer->collect(state.stored);
        return true;
    }
    const std::vector<gpu::PathState> paths = state.emission.next(kBatch);
    state.in_flight = !paths.empty();
    if (state.in_flight) {
        state.tracer->begin(paths, state.batch++);
        return true;
    }
    state.tracer.reset();
    state.sorted = std::async(std::launch::async, [&state] {
        return sortPhotons(std::move(state.stored), state.scene_radius,
                           {state.order.finest, discShrink(state.order.map)});
    });
    return true;
}

CausticMap CausticJob::take(double& finest) {
    PhotonMap map = state_->sorted.get();
    finest = map.finest;
    return uploadCaustics(state_->device, std::move(map));
}

const CausticMap& shownMap(const CausticMaps& maps) { return maps.shows_later ? maps.later : maps.first; }

std::uint64_t deviceBytes(const CausticMaps& maps) { return deviceBytes(maps.first) + deviceBytes(maps.later); }

void destroyCaustics(Device& device, CausticMaps& maps) {
    maps.job.reset();
    for (CausticMap* map : {&maps.first, &maps.later}) destroyCaustics(device, *map);
    maps = {};
}

} // namespace pointrt
