// SPDX-License-Identifier: Apache-2.0
#include "tests/support/ray_caster.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <numeric>

#include "runtime/camera.h"
#include "runtime/frame_params.h"
#include "runtime/program.h"
#include "runtime/scene.h"
#include "shaders/any_hit.spv.h"
#include "shaders/cast_surface.spv.h"
#include "shaders/raygen.spv.h"
#include "shaders/trace.spv.h"

namespace pointrt::test {

namespace {

Vec3 vec(const double (&v)[3]) { return {v[0], v[1], v[2]}; }
Vec3 vec(const gpu::vec4& v) { return {v.x, v.y, v.z}; }

gpu::vec4 pack(Vec3 v, double w) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

} // namespace

struct RayCaster::State {
    State(const DeviceRequest& request, std::uint32_t rays) : device(createDevice(request)), batch_rays(rays) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        destroyDescriptorPool(device, pool);
        for (Program* program : {&trace, &any_hit, &raygen, &surface}) destroyProgram(device, *program);
        for (Buffer* buffer : {&params, &control, &queue, &paths, &hits, &unused, &film, &first_hits})
            destroyBuffer(device, *buffer);
        destroyScene(device, scene);
        destroyDevice(device);
    }

    Device device;
    Scene scene;
    std::uint32_t batch_rays;
    std::uint32_t loaded = 0; ///< rays on the device
    Program trace, any_hit, raygen, surface;
    Buffer params, control, queue, paths, hits, unused, film, first_hits;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE; ///< all programs declare the same bindings (shaders/bindings.glsl)
    double trace_seconds = 0;

    void createBuffers() {
        const auto storage = [&](const char* what, std::uint64_t bytes) {
            return createBuffer(device, what, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        };
        params = storage("frame parameters", sizeof(gpu::FrameParams));
        control = storage("control buffer", sizeof(gpu::Control));
        queue = storage("queue buffer", std::uint64_t{batch_rays} * sizeof(std::uint32_t));
        paths = storage("path buffer", std::uint64_t{batch_rays} * sizeof(gpu::PathState));
        hits = storage("hit buffer", std::uint64_t{batch_rays} * sizeof(gpu::uvec4));
        unused = storage("lit point buffer", sizeof(gpu::LitPoint));
        film = storage("film buffer", std::uint64_t{batch_rays} * sizeof(gpu::vec4));
        first_hits = storage("first hit buffer", std::uint64_t{batch_rays} * sizeof(gpu::vec4));
        queueInOrder();
    }

    void queueInOrder() {
        std::vector<std::uint32_t> in_order(batch_rays);
        std::iota(in_order.begin(), in_order.end(), 0u);
        uploadBuffer(device, queue, in_order.data(), queue.bytes);
    }

    void createPrograms() {
        trace = createProgram(device, "trace", trace_spv);
        any_hit = createProgram(device, "any_hit", any_hit_spv);
        raygen = createProgram(device, "raygen", raygen_spv);
        surface = createProgram(device, "cast_surface", cast_surface_spv);
        pool = createDescriptorPool(device, 1);
        std::vector<BufferBinding> bindings = sceneBindings(scene);
        bindings.insert(bindings.end(), {{6, &params},
                                         {7, &control},
                                         {8, &queue},
                                         {9, &paths},
                                         {10, &hits},
                                         {11, &unused},
                                         {12, &film},
                                         {13, &first_hits}});
        set = createDescriptorSet(device, pool, trace, bindings);
    }

    /// The scene's own parameters are the viewer's; the camera and the light matter to cameraRays alone.
    gpu::FrameParams uploadParams(std::uint32_t size, double fov_deg = CameraRequest{}.fov_deg) {
        Camera camera = frameCamera(CameraRequest{}, vec(scene.info.bounds_min), vec(scene.info.bounds_max), 1.0);
        camera.fov_deg = fov_deg;
        RenderSettings settings;
        settings.width = settings.height = size;
        settings.lights = 1;
        const gpu::FrameParams frame = makeFrameParams(scene, settings, camera, 0, size);
        uploadBuffer(device, params, &frame, sizeof frame);
        return frame;
    }

    void uploadRays(std::span<const Ray> rays) {
        loaded = static_cast<std::uint32_t>(rays.size());
        std::vector<gpu::PathState> packed;
        for (const Ray& ray : rays)
            packed.push_back({pack(ray.origin, ray.own_t), pack(ray.direction, 0), {}, pack(ray.own_normal, 0)});
        uploadBuffer(device, paths, packed.data(), packed.size() * sizeof packed[0]);
        gpu::Control counts{};
        counts.queued.x = loaded;
        uploadBuffer(device, control, &counts, sizeof counts);
    }

    /// Seconds from submission to the end.
    double run(const Program& program, std::uint32_t rays, std::uint32_t step_bits = 0) {
        const gpu::PushParams push{{0, 0, 0, step_bits}};
        const VkCommandBuffer commands = beginCommands(device);
        const std::uint32_t groups = (rays + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE;
        recordDispatch(commands, program, set, pushBytes(push), {groups, 1, 1});
        recordBarrier(commands);
        const auto start = std::chrono::steady_clock::now();
        submitAndWait(device, commands);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    void readFlat(std::span<CastHit> out) {
        std::vector<gpu::uvec4> flat(out.size());
        downloadBuffer(device, hits, flat.data(), flat.size() * sizeof flat[0]);
        for (std::size_t i = 0; i < out.size(); ++i)
            if (flat[i].z != NO_INDEX) out[i].t_flat = std::bit_cast<float>(flat[i].x), out[i].splat = flat[i].z;
    }

    void readBlended(std::span<CastHit> out) {
        std::vector<gpu::vec4> blended(out.size()), radii(out.size());
        downloadBuffer(device, first_hits, blended.data(), blended.size() * sizeof blended[0]);
        downloadBuffer(device, film, radii.data(), radii.size() * sizeof radii[0]);
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (!out[i].hit()) continue;
            out[i].t_blended = blended[i].w;
            out[i].normal = vec(blended[i]);
            out[i].radius = radii[i].x;
        }
    }
};

RayCaster::RayCaster(const std::string& path, const DeviceRequest& request, std::uint32_t batch_rays)
    : state_(new State(request, batch_rays)) {
    state_->scene = loadScene(state_->device, path, false);
    state_->createBuffers();
    state_->createPrograms();
    state_->uploadParams(1);
}

RayCaster::~RayCaster() = default;

std::vector<CastHit> RayCaster::cast(std::span<const Ray> rays) {
    std::vector<CastHit> hits(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += state_->batch_rays) {
        const std::size_t count = std::min<std::size_t>(state_->batch_rays, rays.size() - first);
        load(rays.subspan(first, count));
        traceLoaded();
        state_->run(state_->surface, state_->loaded);
        const std::span<CastHit> batch = std::span(hits).subspan(first, count);
        state_->readFlat(batch);
        state_->readBlended(batch);
    }
    return hits;
}

std::vector<Ray> RayCaster::cameraRays(std::uint32_t size, double fov_deg) {
    const std::uint32_t pixels = size * size;
    state_->uploadParams(size, fov_deg);
    state_->run(state_->raygen, pixels, STEP_CENTER | STEP_FIRST_HIT);
    std::vector<std::uint32_t> lanes(pixels);
    std::vector<gpu::PathState> paths(pixels);
    downloadBuffer(state_->device, state_->queue, lanes.data(), pixels * sizeof lanes[0]);
    downloadBuffer(state_->device, state_->paths, paths.data(), pixels * sizeof paths[0]);
    state_->queueInOrder();
    std::vector<Ray> rays;
    for (const std::uint32_t pixel : lanes)
        rays.push_back({vec(paths.at(pixel).origin), vec(paths.at(pixel).direction), {}, 0});
    return rays;
}

Vec3 RayCaster::lightPosition() const { return vec(state_->uploadParams(1).light_position[0]); }

void RayCaster::load(std::span<const Ray> rays) { state_->uploadRays(rays); }

double RayCaster::traceLoaded(bool any_hit) {
    const double seconds = state_->run(any_hit ? state_->any_hit : state_->trace, state_->loaded);
    state_->trace_seconds += seconds;
    return seconds;
}

std::vector<CastHit> RayCaster::loadedHits() {
    std::vector<CastHit> hits(state_->loaded);
    state_->readFlat(hits);
    return hits;
}

double RayCaster::traceSeconds() const { return state_->trace_seconds; }
const std::string& RayCaster::deviceName() const { return state_->device.name; }
std::uint64_t RayCaster::sceneDeviceBytes() const { return state_->scene.device_bytes; }

} // namespace pointrt::test
