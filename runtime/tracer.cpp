// SPDX-License-Identifier: Apache-2.0
#include "runtime/tracer.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "runtime/frame_params.h"
#include "runtime/program.h"
#include "shaders/beam.spv.h"
#include "shaders/prepare.spv.h"
#include "shaders/shade.spv.h"
#include "shaders/shadow.spv.h"
#include "shaders/trace.spv.h"
#include "shaders/trace_primary.spv.h"

namespace pointrt {

namespace {

/// Pixels in flight: their states take about 200 bytes each, so that no buffer nears the 128 MiB that some drivers
/// allow in a storage binding. Larger images are rendered in bands of rows.
constexpr std::uint32_t kBandPixels = 1u << 19;

} // namespace

struct TracerState {
    RenderSettings settings;
    Camera camera;
    const Scene* scene = nullptr;
    std::uint32_t band_rows = 0;
    Program beam, trace_primary, trace, shade, shadow, prepare;
    Buffer params, control, queues, paths, hits, lit, film, first_hits, beams;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE; ///< all programs declare the same bindings (shaders/bindings.glsl)
    std::uint64_t device_bytes = 0;
    Film result;
};

namespace {

std::uint32_t tilesOf(std::uint32_t width, std::uint32_t rows) {
    return (width + TILE_SIDE - 1) / TILE_SIDE * ((rows + TILE_SIDE - 1) / TILE_SIDE);
}

std::uint32_t lanesOf(std::uint32_t width, std::uint32_t rows) { return tilesOf(width, rows) * TILE_PIXELS; }

void createBuffers(Device& device, TracerState& state) {
    const std::uint32_t width = state.settings.width;
    state.band_rows = std::clamp(kBandPixels / width, 1u, state.settings.height);
    const std::uint64_t pixels = std::uint64_t{width} * state.band_rows;
    const std::uint64_t lanes = lanesOf(width, state.band_rows);
    const auto storage = [&](const char* what, std::uint64_t bytes, VkBufferUsageFlags more = 0) {
        state.device_bytes += bytes;
        return createBuffer(device, what, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | more);
    };
    state.params = storage("frame parameters", sizeof(gpu::FrameParams));
    state.control = storage("control buffer", sizeof(gpu::Control), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
    state.queues = storage("queue buffer", 3 * lanes * sizeof(std::uint32_t), VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    createTexelView(device, "queue buffer", state.queues, VK_FORMAT_R32_UINT);
    state.paths = storage("path buffer", pixels * sizeof(gpu::PathState), VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    createTexelView(device, "path buffer", state.paths, VK_FORMAT_R32G32B32A32_SFLOAT);
    state.hits = storage("hit buffer", pixels * sizeof(gpu::uvec4), VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
    createTexelView(device, "hit buffer", state.hits, VK_FORMAT_R32G32B32A32_UINT);
    state.lit = storage("lit point buffer", pixels * sizeof(gpu::LitPoint));
    state.beams = storage("beam buffer", lanes / TILE_PIXELS * sizeof(float), VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    createTexelView(device, "beam buffer", state.beams, VK_FORMAT_R32_SFLOAT);
    state.film = storage("film buffer", pixels * sizeof(gpu::vec4));
    state.first_hits = storage("first hit buffer", pixels * sizeof(gpu::vec4));
}

void createPrograms(Device& device, TracerState& state) {
    const std::uint32_t uneven = state.scene->grid_frame.uneven;
    state.beam = createProgram(device, "beam", beam_spv);
    state.trace_primary = createProgram(device, "trace_primary", trace_primary_spv, {uneven});
    state.trace = createProgram(device, "trace", trace_spv, {uneven});
    state.shade = createProgram(device, "shade", shade_spv, {uneven});
    state.shadow = createProgram(device, "shadow", shadow_spv, {uneven});
    state.prepare = createProgram(device, "prepare", prepare_spv);
}

void createBindings(Device& device, TracerState& state) {
    std::vector<BufferBinding> bindings = sceneBindings(*state.scene);
    bindings.insert(bindings.end(), {{6, &state.params},
                                     {7, &state.control},
                                     {8, &state.queues},
                                     {9, &state.paths},
                                     {10, &state.hits},
                                     {11, &state.lit},
                                     {12, &state.film},
                                     {13, &state.first_hits},
                                     {17, &state.paths},
                                     {19, &state.beams},
                                     {20, &state.beams},
                                     {18, &state.queues}});
    state.pool = createDescriptorPool(device, 1);
    state.set = createDescriptorSet(device, state.pool, state.trace, bindings);
}

/// Records the dispatches of one sample.
class SampleRecorder {
public:
    SampleRecorder(VkCommandBuffer commands, const TracerState& state, std::uint32_t rows)
        : commands_(commands), state_(state), lanes_(lanesOf(state.settings.width, rows)) {}

    void firstHits() {
        const std::uint32_t bits = STEP_CENTER | STEP_FIRST_HIT;
        run(state_.prepare, 0, bits | STEP_RESET, 1);
        primary(bits);
        runIndirect(state_.shade, 0, bits, offsetof(gpu::Control, ray_groups));
    }

    void sample(std::uint32_t index) {
        sample_ = index;
        center_ = state_.settings.spp == 1 ? STEP_CENTER : 0u;
        run(state_.prepare, 0, STEP_RESET, 1);
        primary(center_);
        for (std::uint32_t b = 0; b <= state_.settings.bounces; ++b) bounce(b, b % 2 ? STEP_QUEUE_ONE : 0u);
    }

private:
    void bounce(std::uint32_t index, std::uint32_t queue) {
        if (index > 0) runIndirect(state_.trace, index, queue, offsetof(gpu::Control, ray_groups));
        runIndirect(state_.shade, index, queue | (index == 0 ? center_ : 0u), offsetof(gpu::Control, ray_groups));
        run(state_.prepare, index, queue, 1);
        if (state_.settings.lights > 0) runIndirect(state_.shadow, index, queue, offsetof(gpu::Control, lit_groups));
    }

    /// First hits of the camera rays.
    void primary(std::uint32_t bits) {
        run(state_.beam, 0, bits, (lanes_ / TILE_PIXELS + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE);
        runIndirect(state_.trace_primary, 0, bits, offsetof(gpu::Control, tile_groups));
    }

    gpu::PushParams push(std::uint32_t bounce, std::uint32_t bits) const { return {{sample_, 0, bounce, bits}}; }

    void run(const Program& program, std::uint32_t bounce, std::uint32_t bits, std::uint32_t count) {
        const gpu::PushParams params = push(bounce, bits);
        recordDispatch(commands_, program, state_.set, pushBytes(params), {count, 1, 1});
        recordBarrier(commands_);
    }

    void runIndirect(const Program& program, std::uint32_t bounce, std::uint32_t bits, std::size_t offset) {
        const gpu::PushParams params = push(bounce, bits);
        recordDispatchIndirect(commands_, program, state_.set, pushBytes(params), state_.control, offset);
        recordBarrier(commands_);
    }

    VkCommandBuffer commands_;
    const TracerState& state_;
    std::uint32_t lanes_;
    std::uint32_t sample_ = 0, center_ = 0;
};

/// Adds the sample's counters, which are 32 bits wide on the device and start at 0 with each sample.
void collectCounts(Device& device, const TracerState& state, RayCounts& counts) {
    gpu::Control control{};
    downloadBuffer(device, state.control, &control, sizeof control);
    counts.primary += control.traced.x;
    counts.shadow += control.traced.y;
    counts.secondary += control.traced.z;
}

void allocateFilm(const RenderSettings& settings, Film& film) {
    const std::size_t pixels = std::size_t{settings.width} * settings.height;
    film.width = settings.width;
    film.height = settings.height;
    film.rgba.assign(4 * pixels, 0.0f);
    if (!settings.first_hits) return;
    film.depth.assign(pixels, std::numeric_limits<float>::infinity());
    film.normal.assign(3 * pixels, 0.0f);
    film.position.assign(3 * pixels, 0.0f);
}

void storeColors(Device& device, TracerState& state, std::uint32_t first_row, std::uint32_t rows) {
    const std::size_t floats = 4 * std::size_t{state.settings.width} * rows;
    float* out = state.result.rgba.data() + 4 * std::size_t{state.settings.width} * first_row;
    downloadBuffer(device, state.film, out, floats * sizeof(float));
    const float share = 1.0f / static_cast<float>(state.settings.spp);
    std::for_each(out, out + floats, [&](float& value) { value *= share; });
}

/// Cube units to input units; positions are taken along the ray in double, and rounded to float once.
void storeFirstHits(Device& device, TracerState& state, std::uint32_t first_row, std::uint32_t rows) {
    const std::uint32_t width = state.settings.width;
    std::vector<gpu::vec4> hits(std::size_t{width} * rows);
    downloadBuffer(device, state.first_hits, hits.data(), hits.size() * sizeof(gpu::vec4));
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t x = 0; x < width; ++x) {
            const gpu::vec4& hit = hits[std::size_t{row} * width + x];
            if (hit.w < 0) continue;
            const std::size_t pixel = std::size_t{first_row + row} * width + x;
            const double distance = hit.w * state.scene->info.scale;
            const Vec3 at =
                state.camera.eye + distance * centerRayDirection(state.settings, state.camera, x, first_row + row);
            state.result.depth[pixel] = static_cast<float>(distance);
            state.result.normal[3 * pixel] = hit.x;
            state.result.normal[3 * pixel + 1] = hit.y;
            state.result.normal[3 * pixel + 2] = hit.z;
            state.result.position[3 * pixel] = static_cast<float>(at.x);
            state.result.position[3 * pixel + 1] = static_cast<float>(at.y);
            state.result.position[3 * pixel + 2] = static_cast<float>(at.z);
        }
}

} // namespace

Tracer createTracer(Device& device, const Scene& scene, const RenderSettings& settings, const Camera& camera) {
    Tracer tracer{std::make_shared<TracerState>()};
    TracerState& state = *tracer.state;
    state.settings = settings;
    state.camera = camera;
    state.scene = &scene;
    try {
        createBuffers(device, state);
        createPrograms(device, state);
        createBindings(device, state);
    } catch (...) {
        destroyTracer(device, tracer);
        throw;
    }
    return tracer;
}

std::uint64_t deviceBytes(const Tracer& tracer) { return tracer.state->device_bytes; }

void destroyTracer(Device& device, Tracer& tracer) {
    if (!tracer.state) return;
    TracerState& state = *tracer.state;
    for (Program* program :
         {&state.beam, &state.trace_primary, &state.trace, &state.shade, &state.shadow, &state.prepare})
        destroyProgram(device, *program);
    destroyDescriptorPool(device, state.pool);
    for (Buffer* buffer : {&state.params, &state.control, &state.queues, &state.paths, &state.hits, &state.lit,
                           &state.film, &state.first_hits, &state.beams})
        destroyBuffer(device, *buffer);
    tracer.state.reset();
}

RayCounts renderFrame(Device& device, Tracer& tracer, const std::function<void(double)>& progress) {
    TracerState& state = *tracer.state;
    const RenderSettings& settings = state.settings;
    RayCounts counts;
    allocateFilm(settings, state.result);
    for (std::uint32_t row = 0; row < settings.height; row += state.band_rows) {
        const std::uint32_t rows = std::min(state.band_rows, settings.height - row);
        const gpu::FrameParams params = makeFrameParams(*state.scene, settings, state.camera, row, rows);
        uploadBuffer(device, state.params, &params, sizeof params);
        for (std::uint32_t s = 0; s < settings.spp; ++s) {
            VkCommandBuffer commands = beginCommands(device);
            SampleRecorder recorder(commands, state, rows);
            if (s == 0 && settings.first_hits) recorder.firstHits();
            recorder.sample(s);
            submitAndWait(device, commands);
            collectCounts(device, state, counts);
            const double bands_done = row + static_cast<double>(rows) * (s + 1) / settings.spp;
            if (progress) progress(bands_done / settings.height);
        }
        storeColors(device, state, row, rows);
        if (settings.first_hits) storeFirstHits(device, state, row, rows);
    }
    return counts;
}

const Film& readFilm(const Tracer& tracer) { return tracer.state->result; }

} // namespace pointrt
