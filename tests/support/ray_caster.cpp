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
#include "shaders/cast_surface.spv.h"
#include "shaders/trace.spv.h"

namespace pointrt::test {

namespace {

/// Rays in flight. Their 132 bytes each stay well below the 128 MiB that some drivers allow in a storage binding.
constexpr std::uint32_t kChunkRays = 1u << 18;

Vec3 vec(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

gpu::vec4 pack(Vec3 v, double w) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), static_cast<float>(w)};
}

} // namespace

struct RayCaster::State {
    explicit State(const DeviceRequest& request) : device(createDevice(request)) {}
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        destroyDescriptorPool(device, pool);
        for (Program* program : {&trace, &surface}) destroyProgram(device, *program);
        for (Buffer* buffer : {&params, &control, &queue, &paths, &hits, &unused, &film, &first_hits})
            destroyBuffer(device, *buffer);
        destroyScene(device, scene);
        destroyDevice(device);
    }

    Device device;
    Scene scene;
    Program trace, surface;
    Buffer params, control, queue, paths, hits, unused, film, first_hits;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE; ///< both programs declare the same bindings (shaders/bindings.glsl)
    double trace_seconds = 0;

    void createBuffers() {
        const auto storage = [&](const char* what, std::uint64_t bytes) {
            return createBuffer(device, what, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
        };
        params = storage("frame parameters", sizeof(gpu::FrameParams));
        control = storage("control buffer", sizeof(gpu::Control));
        queue = storage("queue buffer", kChunkRays * sizeof(std::uint32_t));
        paths = storage("path buffer", kChunkRays * sizeof(gpu::PathState));
        hits = storage("hit buffer", kChunkRays * sizeof(gpu::uvec4));
        unused = storage("lit point buffer", sizeof(gpu::LitPoint));
        film = storage("film buffer", kChunkRays * sizeof(gpu::vec4));
        first_hits = storage("first hit buffer", kChunkRays * sizeof(gpu::vec4));
        std::vector<std::uint32_t> in_order(kChunkRays);
        std::iota(in_order.begin(), in_order.end(), 0u);
        uploadBuffer(device, queue, in_order.data(), queue.bytes);
    }

    void createPrograms() {
        trace = createProgram(device, "trace", trace_spv);
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

    /// The scene's own parameters are the viewer's; its camera plays no part.
    void uploadParams() {
        const Camera camera = frameCamera(CameraRequest{}, vec(scene.info.bounds_min), vec(scene.info.bounds_max), 1.0);
        const gpu::FrameParams frame = makeFrameParams(scene, RenderSettings{}, camera, 0, 1);
        uploadBuffer(device, params, &frame, sizeof frame);
    }

    void uploadRays(std::span<const Ray> rays) {
        std::vector<gpu::PathState> packed;
        for (const Ray& ray : rays)
            packed.push_back({pack(ray.origin, ray.own_t), pack(ray.direction, 0), {}, pack(ray.own_normal, 0)});
        uploadBuffer(device, paths, packed.data(), packed.size() * sizeof packed[0]);
        gpu::Control counts{};
        counts.queued.x = static_cast<std::uint32_t>(rays.size());
        uploadBuffer(device, control, &counts, sizeof counts);
    }

    /// Seconds from submission to the end.
    double run(const Program& program, std::size_t rays) {
        const gpu::PushParams push{{0, 0, 0, 0}};
        const VkCommandBuffer commands = beginCommands(device);
        const auto groups = static_cast<std::uint32_t>((rays + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE);
        recordDispatch(commands, program, set, pushBytes(push), {groups, 1, 1});
        recordBarrier(commands);
        const auto start = std::chrono::steady_clock::now();
        submitAndWait(device, commands);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    void readHits(std::span<CastHit> out) {
        std::vector<gpu::uvec4> flat(out.size());
        std::vector<gpu::vec4> blended(out.size()), radii(out.size());
        downloadBuffer(device, hits, flat.data(), flat.size() * sizeof flat[0]);
        downloadBuffer(device, first_hits, blended.data(), blended.size() * sizeof blended[0]);
        downloadBuffer(device, film, radii.data(), radii.size() * sizeof radii[0]);
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (flat[i].z == NO_INDEX) continue;
            const gpu::vec4& at = blended[i];
            out[i] = {std::bit_cast<float>(flat[i].x), flat[i].z, at.w, {at.x, at.y, at.z}, radii[i].x};
        }
    }
};

RayCaster::RayCaster(const std::string& path, const DeviceRequest& request) : state_(new State(request)) {
    state_->scene = loadScene(state_->device, path, false);
    state_->createBuffers();
    state_->createPrograms();
    state_->uploadParams();
}

RayCaster::~RayCaster() = default;

std::vector<CastHit> RayCaster::cast(std::span<const Ray> rays) {
    std::vector<CastHit> hits(rays.size());
    for (std::size_t first = 0; first < rays.size(); first += kChunkRays) {
        const std::size_t count = std::min<std::size_t>(kChunkRays, rays.size() - first);
        state_->uploadRays(rays.subspan(first, count));
        state_->trace_seconds += state_->run(state_->trace, count);
        state_->run(state_->surface, count);
        state_->readHits(std::span(hits).subspan(first, count));
    }
    return hits;
}

double RayCaster::traceSeconds() const { return state_->trace_seconds; }
const std::string& RayCaster::deviceName() const { return state_->device.name; }

} // namespace pointrt::test
