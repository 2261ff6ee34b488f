// SPDX-License-Identifier: Apache-2.0
#include "tests/support/ray_caster.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "format/base/error.h"
#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/program.h"
#include "runtime/render/caustic_map.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/render/frame_params.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/default_lighting.h"
#include "runtime/util/pack.h"
#include "shaders/any_hit.spv.h"
#include "shaders/any_hit_hardware.spv.h"
#include "shaders/beam.spv.h"
#include "shaders/camera_rays.spv.h"
#include "shaders/cast_surface.spv.h"
#include "shaders/intersect_camera.spv.h"
#include "shaders/intersect_camera_hardware.spv.h"
#include "shaders/intersect_closest.spv.h"
#include "shaders/intersect_closest_hardware.spv.h"
#include "shaders/resolve_hits.spv.h"

namespace pointrt::test {

namespace {

/// The queues up to LIST_INSTANCE_RAYS (shaders/lib/bindings.glsl).
constexpr std::uint64_t kQueues = 5;

gpu::vec3 gpuVector(Vec3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

} // namespace

struct RayCaster::State {
    State(const DeviceRequest& request, std::uint32_t rays) : device(createDevice(request)), batch_rays(rays) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        destroyDescriptorPool(device, pool);
        for (Program* program :
             {&intersect_closest, &intersect_camera, &any_hit, &beam, &camera_rays, &resolve, &surface})
            destroyProgram(device, *program);
        destroyFrameBuffers(device, buffers);
        destroyCaustics(device, no_caustics);
        destroyDeviceScene(device, scene);
        destroyDevice(device);
    }

    Device device;
    DeviceScene scene;
    std::uint32_t batch_rays;
    std::uint32_t loaded = 0; ///< rays on the device
    bool any_traced = false;  ///< the last trace was an any-hit trace
    Program intersect_closest, intersect_camera, any_hit, beam, camera_rays, resolve, surface;
    FrameBuffers buffers;
    CausticMap no_caustics;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    DescriptorSets sets; ///< all programs declare the same bindings (shaders/lib/bindings.glsl)
    double trace_seconds = 0;
    std::vector<Ray> view_rays; ///< of the camera, in the order of its lanes
    gpu::FrameParams view_params{};

    /// Buffers that none of the programs used here writes have the minimum size.
    void createBuffers() {
        const auto storage = [&](const char* what, std::uint64_t bytes, VkBufferUsageFlags more = 0) {
            return createBuffer(device, what, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | more);
        };
        const auto texels = [&](const char* what, std::uint64_t bytes, VkFormat format,
                                VkBufferUsageFlags usage = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT) {
            Buffer buffer = storage(what, bytes, usage);
            createTexelView(device, what, buffer, format);
            return buffer;
        };
        const std::uint64_t rays = batch_rays;
        buffers.params = storage("frame parameters", sizeof(gpu::FrameParams), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
        buffers.control = storage("control buffer", sizeof(gpu::Control), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
        buffers.queues = texels("queue buffer", kQueues * lanes() * sizeof(std::uint32_t), VK_FORMAT_R32_UINT);
        buffers.paths = texels("path buffer", rays * sizeof(gpu::PathState), VK_FORMAT_R32G32B32A32_UINT);
        buffers.hits = texels("hit buffer", rays * sizeof(gpu::uvec4), VK_FORMAT_R32G32B32A32_UINT,
                              VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
        buffers.beams =
            texels("beam buffer", (rays + TILE_PIXELS - 1) / TILE_PIXELS * sizeof(float), VK_FORMAT_R32_SFLOAT);
        buffers.film = storage("film buffer", rays * sizeof(gpu::vec4));
        buffers.first_hits = storage("first hit buffer", rays * sizeof(gpu::vec4));
        buffers.surfaces = texels("surface buffer", sizeof(gpu::StoredSurface), VK_FORMAT_R32G32B32A32_UINT);
        buffers.light_queries =
            texels("light query buffer", sizeof(gpu::DirectLightQuery), VK_FORMAT_R32G32B32A32_UINT);
        buffers.light_masks = storage("light mask buffer", rays * sizeof(std::uint32_t));
        buffers.deferred = storage("deferred ray buffer", sizeof(gpu::PathState));
        buffers.no_cull_boxes = storage("blank cull boxes", sizeof(gpu::CullBoxes), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
        buffers.pixel_list = texels("pixel list", sizeof(std::uint32_t), VK_FORMAT_R32_UINT);
        buffers.gaussian_light = storage("blank Gaussian light buffer", sizeof(gpu::vec4));
        buffers.waiting_gaussians = storage("blank waiting Gaussian buffer", sizeof(gpu::vec4));
        no_caustics = emptyCaustics(device);
        listInOrder();
    }

    /// Number of rows, one tile wide, that hold a batch.
    std::uint32_t bandRows() const { return (batch_rays + TILE_SIDE - 1) / TILE_SIDE; }
    std::uint64_t lanes() const { return lanesOf(TILE_SIDE, bandRows()); }

    /// Puts every ray of a batch into LIST_INSTANCE_RAYS, as shaders/trace/intersect_shapes.comp.glsl does with those
    /// that may hit an instance. Nothing else writes there.
    void listInOrder() {
        std::vector<std::uint32_t> in_order(batch_rays);
        std::iota(in_order.begin(), in_order.end(), 0u);
        uploadBuffer(device, buffers.queues, in_order.data(), in_order.size() * sizeof in_order[0],
                     (kQueues - 1) * lanes() * sizeof in_order[0]);
    }

    void createPrograms() {
        const SpecConstant traits[] = {{SPEC_UNEVEN, file().index.uneven},
                                       {SPEC_ORIENTED, scene.instances[0].oriented},
                                       {SPEC_NOISY, file().noisy},
                                       {SPEC_CLIPS_TO_CORE, 0},
                                       {SPEC_CLIPPED, scene.features & FEATURE_CLIPS},
                                       {SPEC_HAS_BALLS, (file().info.flags & PRO_FLAG_BALLS) != 0},
                                       {SPEC_READS_STORAGE, file().reads_storage},
                                       {SPEC_INTEGRATOR, 0},
                                       {SPEC_FEATURES, ~0u},
                                       {SPEC_CAMERA_PASS, 0},
                                       {SPEC_GATHERS_PHOTONS, 0},
                                       {SPEC_ONE_BOUNCE, 0},
                                       {SPEC_SHAPE_KINDS, 0},
                                       {SPEC_PANORAMA_EYES, 0}};
        const auto build = [&](const char* name, std::span<const std::uint32_t> spirv) {
            return createProgram(device, name, spirv, traits);
        };
        using Words = std::span<const std::uint32_t>;
        const auto buildTrace = [&](const char* name, Words walk, Words hardware) {
            return build(name, file().queries_rays ? hardware : walk);
        };
        intersect_closest = buildTrace("intersect_closest", intersect_closest_spv, intersect_closest_hardware_spv);
        any_hit = buildTrace("any_hit", any_hit_spv, any_hit_hardware_spv);
        intersect_camera = buildTrace("intersect_camera", intersect_camera_spv, intersect_camera_hardware_spv);
        beam = build("beam", beam_spv);
        camera_rays = build("camera_rays", camera_rays_spv);
        resolve = build("resolve_hits", resolve_hits_spv);
        surface = build("cast_surface", cast_surface_spv);
        bindAll();
    }

    void bindAll() {
        pool = createDescriptorPool(device, 2);
        std::vector<BufferBinding> bindings = instanceBindings(scene, scene.instances[0]);
        const std::vector<BufferBinding> frame = frameBindings(buffers);
        bindings.insert(bindings.end(), frame.begin(), frame.end());
        bindings.push_back({BINDING_CULL_BOXES, &buffers.no_cull_boxes});
        const std::vector<BufferBinding> caustics = causticBindings(no_caustics);
        bindings.insert(bindings.end(), caustics.begin(), caustics.end());
        sets = createDescriptorSet(device, pool, intersect_closest, bindings);
        if (file().queries_rays)
            sets.sets[1] = createDescriptorSet(device, pool, intersect_closest, treeBindings(file().tree), SET_PAGES);
    }

    Camera cameraOf(const CameraRequest& request) const {
        return frameCamera(request, scene.bounds.lo, scene.bounds.hi, 1.0);
    }

    const DeviceScan& file() const { return scene.files[0]; }

    void open(const std::string& path) {
        SceneDescription description;
        description.instances.push_back({path, {}, {}, {}});
        scene = openScene(device, std::move(description), false);
        if (isPaged(file().pages))
            throw Error{ExitCode::kCannotRun, path + ": too large for this device's texel buffers"};
        if (device.queries_rays && !file().queries_rays)
            throw Error{ExitCode::kCannotRun, path + ": has no boxes for ray queries"};
        RenderSettings settings;
        settings.lights = 1;
        addSurroundings(scene.description, settings, cameraOf({}), scene.bounds.lo, scene.bounds.hi);
        uploadSceneTables(device, scene, settings);
    }

    /// Parameters as in the viewer; the camera and the light affect cameraRays only.
    gpu::FrameParams frameParams(std::uint32_t size, const Camera& camera) const {
        RenderSettings settings;
        settings.width = settings.height = size;
        return makeFrameParams(scene, settings, camera, 0, size);
    }

    void uploadParams(const gpu::FrameParams& frame) { uploadBuffer(device, buffers.params, &frame, sizeof frame); }

    void uploadRayParams() {
        gpu::FrameParams params = frameParams(1, cameraOf({}));
        params.width = TILE_SIDE;
        params.height = params.rows = bandRows();
        uploadParams(params);
    }

    /// Resets hits to misses, as shaders/trace/intersect_shapes.comp.glsl does without shapes.
    void clearHits(std::size_t rays) {
        const std::vector<gpu::uvec4> none(rays,
                                           gpu::uvec4{std::bit_cast<std::uint32_t>(1e30f), NO_INDEX, NO_INDEX, 0});
        uploadBuffer(device, buffers.hits, none.data(), none.size() * sizeof none[0]);
    }

    /// Counters for a trace of the loaded rays.
    void uploadCounts() {
        gpu::Control counts{};
        counts.queued[0] = loaded;
        counts.lists[LIST_INSTANCE_RAYS].count = loaded;
        counts.lists[LIST_INSTANCE_RAYS].start = static_cast<std::uint32_t>((kQueues - 1) * lanes());
        uploadBuffer(device, buffers.control, &counts, sizeof counts);
    }

    void uploadRays(std::span<const Ray> rays) {
        loaded = static_cast<std::uint32_t>(rays.size());
        std::vector<gpu::PathState> packed;
        for (const Ray& ray : rays)
            packed.push_back({gpuVector(ray.origin),
                              static_cast<float>(ray.self_t),
                              gpuVector(ray.direction),
                              0,
                              {},
                              0,
                              gpuVector(ray.self_normal),
                              ray.diffused ? PATH_DIFFUSED : 0u}); // of instance 0
        uploadBuffer(device, buffers.paths, packed.data(), packed.size() * sizeof packed[0]);
        uploadRayParams();
        uploadCounts();
    }

    double submitTimed(VkCommandBuffer commands) {
        const auto start = std::chrono::steady_clock::now();
        submitAndWait(device, commands);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    /// Returns seconds from submission to completion.
    double run(const Program& program, std::uint32_t rays, std::uint32_t step_bits = 0) {
        const gpu::PushParams push{0, 0, step_bits, LIST_INSTANCE_RAYS};
        const VkCommandBuffer commands = beginCommands(device);
        const std::uint32_t groups = (rays + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE;
        recordDispatch(commands, program, sets, pushBytes(push), {groups, 1, 1});
        recordBarrier(commands);
        return submitTimed(commands);
    }

    std::vector<Ray> viewRays(std::uint32_t size, const Camera& camera) {
        const std::uint32_t pixels = size * size;
        view_params = frameParams(size, camera);
        uploadParams(view_params);
        run(camera_rays, pixels, STEP_CENTER);
        std::vector<gpu::vec4> lanes(pixels), origins(pixels);
        downloadBuffer(device, buffers.first_hits, lanes.data(), pixels * sizeof lanes[0]);
        downloadBuffer(device, buffers.film, origins.data(), pixels * sizeof origins[0]);
        view_rays.clear();
        for (std::uint32_t lane = 0; lane < pixels; ++lane)
            view_rays.push_back({unpack(origins[lane]), unpack(lanes[lane]), {}, 0});
        return view_rays;
    }

    /// Beams, then closest hits. Pixels whose beam misses keep NO_INDEX, set before the timing starts.
    double traceCamera() {
        const auto pixels = static_cast<std::uint32_t>(view_rays.size());
        uploadParams(view_params);
        clearHits(pixels);
        gpu::Control counts{};
        counts.tile_groups = {0, 1, 1};
        uploadBuffer(device, buffers.control, &counts, sizeof counts);
        const gpu::PushParams push{0, 0, STEP_CENTER, 0};
        const VkCommandBuffer commands = beginCommands(device);
        recordDispatch(commands, beam, sets, pushBytes(push),
                       {(pixels / TILE_PIXELS + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE, 1, 1});
        recordBarrier(commands);
        recordDispatchIndirect(commands, intersect_camera, sets, pushBytes(push), buffers.control,
                               offsetof(gpu::Control, tile_groups));
        recordBarrier(commands);
        return submitTimed(commands);
    }

    /// Marks all rays unoccluded.
    void clearMasks() {
        const std::vector<std::uint32_t> none(loaded);
        uploadBuffer(device, buffers.light_masks, none.data(), none.size() * sizeof none[0]);
    }

    /// Hits of an any-hit trace, which has occlusion only.
    std::vector<CastHit> readMasks() {
        std::vector<std::uint32_t> masks(loaded);
        downloadBuffer(device, buffers.light_masks, masks.data(), masks.size() * sizeof masks[0]);
        std::vector<CastHit> hits(loaded);
        for (std::size_t i = 0; i < hits.size(); ++i)
            if (masks[i] != 0) hits[i].splat = 0;
        return hits;
    }

    /// Reads hits of the rays on the device.
    void readFlat(std::span<CastHit> out) {
        run(resolve, loaded);
        std::vector<gpu::vec4> flat(out.size());
        downloadBuffer(device, buffers.first_hits, flat.data(), flat.size() * sizeof flat[0]);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const auto splat = std::bit_cast<std::uint32_t>(flat[i].y);
            if (splat != NO_INDEX) out[i].t_flat = flat[i].x, out[i].splat = splat;
        }
    }

    void readBlended(std::span<CastHit> out) {
        std::vector<gpu::vec4> blended(out.size()), radii(out.size());
        downloadBuffer(device, buffers.first_hits, blended.data(), blended.size() * sizeof blended[0]);
        downloadBuffer(device, buffers.film, radii.data(), radii.size() * sizeof radii[0]);
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (!out[i].hit()) continue;
            out[i].t_blended = blended[i].w;
            out[i].normal = unpack(blended[i]);
            out[i].radius = radii[i].x;
            out[i].back = radii[i].y != 0;
        }
    }
};

RayCaster::RayCaster(const std::string& path, const DeviceRequest& request, std::uint32_t batch_rays)
    : state_(new State(request, batch_rays)) {
    state_->open(path);
    state_->createBuffers();
    state_->createPrograms();
    state_->uploadRayParams();
}

RayCaster::~RayCaster() = default;

std::vector<CastHit> RayCaster::cast(std::span<const Ray> rays) {
    std::vector<CastHit> hits(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += state_->batch_rays) {
        const std::size_t count = std::min<std::size_t>(state_->batch_rays, rays.size() - first);
        load(rays.subspan(first, count));
        traceLoaded();
        const std::span<CastHit> batch = std::span(hits).subspan(first, count);
        state_->readFlat(batch);
        state_->run(state_->surface, state_->loaded);
        state_->readBlended(batch);
    }
    return hits;
}

std::vector<Ray> RayCaster::cameraRays(std::uint32_t size, double fov_deg) {
    Camera camera = state_->cameraOf({});
    camera.fov_deg = fov_deg;
    return state_->viewRays(size, camera);
}

std::vector<Ray> RayCaster::cameraRays(std::uint32_t size, const CameraRequest& request) {
    return state_->viewRays(size, state_->cameraOf(request));
}

double RayCaster::traceCamera() { return state_->traceCamera(); }

std::vector<CastHit> RayCaster::cameraHits() {
    load(state_->view_rays);
    state_->any_traced = false;
    return loadedHits();
}

Vec3 RayCaster::lightPosition() const { return unpack(state_->scene.light_rows.at(0).position); }

void RayCaster::load(std::span<const Ray> rays) { state_->uploadRays(rays); }

double RayCaster::traceLoaded(bool any_hit) {
    if (any_hit) state_->clearMasks();
    state_->clearHits(state_->loaded);
    state_->uploadCounts();
    state_->any_traced = any_hit;
    const double seconds = state_->run(any_hit ? state_->any_hit : state_->intersect_closest, state_->loaded);
    state_->trace_seconds += seconds;
    return seconds;
}

std::vector<CastHit> RayCaster::loadedHits() {
    if (state_->any_traced) return state_->readMasks();
    std::vector<CastHit> hits(state_->loaded);
    state_->readFlat(hits);
    return hits;
}

double RayCaster::blendHits() { return state_->run(state_->surface, state_->loaded); }

double RayCaster::traceSeconds() const { return state_->trace_seconds; }
const std::string& RayCaster::deviceName() const { return state_->device.name; }
double RayCaster::cellEdge() const {
    const int grid_shift = static_cast<int>(state_->file().index.shift);
    return std::ldexp(1.0 / PRO_BRICK_SIDE, grid_shift - static_cast<int>(PRO_POSITION_BITS));
}
bool RayCaster::isUneven() const { return state_->file().index.uneven; }
std::uint64_t RayCaster::sceneDeviceBytes() const { return state_->scene.device_bytes; }

} // namespace pointrt::test
