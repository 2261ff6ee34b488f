// SPDX-License-Identifier: Apache-2.0
#include "runtime/tracer/caustics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>

#include "runtime/tracer/frame_buffers.h"
#include "runtime/tracer/frame_params.h"
#include "runtime/tracer/photon_emission.h"
#include "runtime/tracer/photon_map.h"

namespace pointrt {

namespace {

/// Photons in flight, as a band of pixels.
constexpr std::uint32_t kBatchWidth = 512, kBatchRows = 256;
constexpr std::uint32_t kBatch = kBatchWidth * kBatchRows;
/// Mirrors and glass in a photon's way, at most: more than light keeps much of itself through.
constexpr std::uint32_t kPhotonBounces = 16;
/// Each photon asks each instance: with more of them than this there are fewer photons, so that the time stays the
/// same.
constexpr std::size_t kInstancesForAll = 8;

void storeMap(Device& device, CausticMap& map, PhotonMap sorted) {
    map.frame = sorted.frame;
    map.photons = createTexelRows(device, "photon buffer", std::move(sorted.photons), VK_FORMAT_R32G32B32A32_UINT);
    map.buckets = createTexelRows(device, "photon buckets", std::move(sorted.buckets), VK_FORMAT_R32_UINT);
}

RenderSphere sphereAround(const RenderSpace& space, const Bounds& bounds) {
    const Vec3 lo = renderPoint(space, bounds.lo), hi = renderPoint(space, bounds.hi);
    return {0.5 * (lo + hi), 0.5 * length(hi - lo)};
}

/// With all that may stand in the sun's way, but endless planes.
Bounds boundsWithShapes(const DeviceScene& scene) {
    const std::optional<Bounds> shapes = boundsOfShapes(scene.description);
    return shapes ? joined(scene.bounds, *shapes) : scene.bounds;
}

/// Around the shape's unit form, by the inverse of its rows: a similarity but for unequal edges.
PhotonTarget shapeTarget(const DeviceScene& scene, std::size_t number) {
    const ShapeDescription& shape = scene.description.shapes[number];
    const bool round = shape.kind == ShapeKind::kSphere || shape.kind == ShapeKind::kDisc;
    const bool flat = shape.kind == ShapeKind::kQuad;
    const double uu = dot(shape.u, shape.u), vv = dot(shape.v, shape.v), ww = dot(shape.w, shape.w);
    const double squared = round ? std::max(uu, vv) : uu + vv + (flat ? 0 : ww);
    return {renderPoint(scene.space, shape.center), std::sqrt(squared) / scene.space.scale,
            OWNER_SHAPES | static_cast<std::uint32_t>(number) << PHOTON_SHAPE_SHIFT};
}

std::vector<PhotonTarget> findTargets(const DeviceScene& scene) {
    std::vector<PhotonTarget> targets;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        if (!scene.instances[i].params.materials.w) continue;
        const pro_info& info = scene.files[scene.instances[i].file].info;
        const Bounds bounds = placedBounds(scene.description.instances[i].placement, info);
        const RenderSphere around = sphereAround(scene.space, bounds);
        targets.push_back({around.center, around.radius, static_cast<std::uint32_t>(i)});
    }
    for (std::size_t i = 0; i < scene.description.shapes.size(); ++i)
        if (scene.casting_shapes[i]) targets.push_back(shapeTarget(scene, i));
    return targets;
}

/// The tracer's programs over a batch of photons.
class PhotonTracer {
public:
    PhotonTracer(Device& device, const DeviceScene& scene, const Programs& programs, CausticMap& map)
        : device_(device), scene_(scene), programs_(programs), map_(map),
          buffers_(createFrameBuffers(device, kBatch, kBatch)) {
        try {
            bindAll();
        } catch (...) {
            release();
            throw;
        }
    }
    PhotonTracer(const PhotonTracer&) = delete;
    PhotonTracer& operator=(const PhotonTracer&) = delete;
    ~PhotonTracer() { release(); }

    /// Appends what is left of count photons (at most kBatch) to kept.
    void trace(const gpu::PathState* paths, std::size_t count, std::uint32_t batch, std::vector<gpu::Photon>& kept) {
        std::vector<gpu::Photon> traced(kBatch);
        uploadBuffer(device_, map_.traced, traced.data(), map_.traced.bytes);
        uploadBuffer(device_, buffers_.paths, paths, count * sizeof *paths);
        std::vector<std::uint32_t> queue(count);
        std::iota(queue.begin(), queue.end(), 0u);
        // pass 1 reads queue 1
        uploadBuffer(device_, buffers_.queues, queue.data(), count * sizeof queue[0], kBatch * sizeof queue[0]);
        gpu::Control control{};
        control.queued[1] = static_cast<std::uint32_t>(count);
        control.ray_groups = {static_cast<std::uint32_t>((count + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE), 1, 1};
        uploadBuffer(device_, buffers_.control, &control, sizeof control);
        for (std::uint32_t pass = 1; pass <= kPhotonBounces + 1; ++pass) {
            // by themselves: a window that shares the queue goes on between them
            const VkCommandBuffer commands = beginCommands(device_);
            record(commands, pass, batch);
            submitAndWait(device_, commands);
        }
        downloadBuffer(device_, map_.traced, traced.data(), map_.traced.bytes);
        std::copy_if(traced.begin(), traced.begin() + static_cast<std::ptrdiff_t>(count), std::back_inserter(kept),
                     [](const gpu::Photon& photon) { return photon.flux.w > 0; });
    }

private:
    void release() {
        destroyDescriptorPool(device_, pool_);
        destroyFrameBuffers(device_, buffers_);
    }

    void bindAll() {
        const std::size_t count = std::max<std::size_t>(scene_.instances.size(), 1);
        pool_ = createDescriptorPool(device_, static_cast<std::uint32_t>(2 * count));
        for (const Instance& instance : scene_.instances) sets_.push_back(bind(instance));
        if (sets_.empty()) sets_.push_back(bind(scene_.blank));
        gpu::FrameParams params{};
        params.width = kBatchWidth;
        params.height = params.rows = kBatchRows;
        params.options = OPTION_BLEND;
        params.shape_count = scene_.shape_count;
        params.sky_light = NO_LIGHT;
        params.integrator = static_cast<std::uint32_t>(Integrator::kPath);
        params.bounces = kPhotonBounces;
        setReach(scene_, params);
        uploadBuffer(device_, buffers_.params, &params, sizeof params);
    }

    DescriptorSets bind(const Instance& instance) {
        return bindInstance(device_, pool_, programs_, scene_, instance, buffers_, map_);
    }

    void record(VkCommandBuffer commands, std::uint32_t pass, std::uint32_t batch) {
        const std::uint32_t queue = pass % 2 ? STEP_QUEUE_ONE : 0u;
        const auto run = [&](const Program& program, const DescriptorSets& sets, std::size_t groups) {
            const gpu::PushParams push{batch, 0, queue, 0};
            recordDispatchIndirect(commands, program, sets, pushBytes(push), buffers_.control, groups);
            recordBarrier(commands);
        };
        const auto prepare = [&](std::uint32_t bits) {
            const gpu::PushParams push{batch, 0, queue | bits, 0};
            recordDispatch(commands, programs_.prepare, sets_[0], pushBytes(push), {1, 1, 1});
            recordBarrier(commands);
        };
        run(programs_.queued.trace_shapes, sets_[0], offsetof(gpu::Control, ray_groups));
        prepare(STEP_ASKED);
        for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
            const InstancePrograms& programs = programsFor(programs_, scene_, scene_.instances[i]);
            run(programs.trace, sets_[i], offsetof(gpu::Control, asked_groups));
            prepare(STEP_HITS);
            run(programs.surface, sets_[i], offsetof(gpu::Control, hit_groups));
        }
        run(programs_.photon, sets_[0], offsetof(gpu::Control, ray_groups));
        prepare(0);
    }

    Device& device_;
    const DeviceScene& scene_;
    const Programs& programs_;
    CausticMap& map_;
    FrameBuffers buffers_;
    VkDescriptorPool pool_ = VK_NULL_HANDLE;
    std::vector<DescriptorSets> sets_;
};

} // namespace

CausticMap emptyCaustics(Device& device) {
    CausticMap map;
    storeMap(device, map, {});
    map.traced = createBuffer(device, "traced photon buffer", sizeof(gpu::Photon), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    return map;
}

CausticMap buildCaustics(Device& device, const DeviceScene& scene, const Programs& programs, std::uint32_t count) {
    count /= static_cast<std::uint32_t>(1 + scene.instances.size() / kInstancesForAll);
    const std::vector<gpu::PathState> paths =
        emitPhotons(scene.light_rows, findTargets(scene), sphereAround(scene.space, boundsWithShapes(scene)), count);
    CausticMap map = emptyCaustics(device);
    if (paths.empty()) return map;
    std::vector<gpu::Photon> kept;
    try {
        destroyBuffer(device, map.traced);
        map.traced = createBuffer(device, "traced photon buffer", kBatch * sizeof(gpu::Photon),
                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        PhotonTracer tracer(device, scene, programs, map);
        for (std::size_t first = 0; first < paths.size(); first += kBatch)
            tracer.trace(paths.data() + first, std::min<std::size_t>(kBatch, paths.size() - first),
                         static_cast<std::uint32_t>(first / kBatch), kept);
    } catch (...) {
        destroyCaustics(device, map);
        throw;
    }
    destroyCaustics(device, map);
    map = emptyCaustics(device);
    for (Buffer* buffer : {&map.photons, &map.buckets}) destroyBuffer(device, *buffer);
    storeMap(device, map, sortPhotons(std::move(kept), sphereAround(scene.space, scene.bounds).radius));
    return map;
}

std::vector<BufferBinding> causticBindings(const CausticMap& map) {
    return {
        {BINDING_PHOTON_TEXELS, &map.photons}, {BINDING_PHOTON_BUCKETS, &map.buckets}, {BINDING_PHOTONS, &map.traced}};
}

void destroyCaustics(Device& device, CausticMap& map) {
    for (Buffer* buffer : {&map.photons, &map.buckets, &map.traced}) destroyBuffer(device, *buffer);
}

} // namespace pointrt
