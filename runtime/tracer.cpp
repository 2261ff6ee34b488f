// SPDX-License-Identifier: Apache-2.0
#include "runtime/tracer.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include "runtime/caustics.h"
#include "runtime/film_readout.h"
#include "runtime/frame_buffers.h"
#include "runtime/frame_params.h"
#include "runtime/programs.h"

namespace pointrt {

namespace {

/// Pixels in flight: their states take about 500 bytes each, no more than 128 in any buffer, so that none nears the 128
/// MiB that some drivers allow in a storage binding. Larger images are rendered in bands of rows.
constexpr std::uint32_t kBandPixels = 1u << 19;

/// Photons that set out for a picture: what a core traces in a second or two.
constexpr std::uint32_t kPhotons = 1u << 20;

/// An instance with what it is traced by.
struct Target {
    const InstancePrograms* programs = nullptr;
    VkDescriptorSet set = VK_NULL_HANDLE;
};

} // namespace

struct TracerState {
    RenderSettings settings;
    Camera camera;
    const StagedScene* scene = nullptr;
    std::uint32_t band_rows = 0;
    Programs programs;
    FrameBuffers buffers;
    CausticMap caustics;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    std::vector<Target> targets;
    VkDescriptorSet set = VK_NULL_HANDLE; ///< for what looks at no instance
    Film result;
};

namespace {

/// One set an instance: all programs declare the same bindings (shaders/bindings.glsl).
void createBindings(Device& device, TracerState& state) {
    const StagedScene& scene = *state.scene;
    const auto count = static_cast<std::uint32_t>(std::max<std::size_t>(scene.instances.size(), 1));
    state.pool = createDescriptorPool(device, count);
    const auto addSet = [&](const Instance& instance) {
        std::vector<BufferBinding> bindings = instanceBindings(scene, instance);
        const std::vector<BufferBinding> frame = frameBindings(state.buffers);
        bindings.insert(bindings.end(), frame.begin(), frame.end());
        const std::vector<BufferBinding> caustics = causticBindings(state.caustics);
        bindings.insert(bindings.end(), caustics.begin(), caustics.end());
        return createDescriptorSet(device, state.pool, state.programs.shade, bindings);
    };
    for (const Instance& instance : scene.instances)
        state.targets.push_back({&programsFor(state.programs, scene, instance), addSet(instance)});
    state.set = state.targets.empty() ? addSet(scene.blank) : state.targets.front().set;
}

/// Records the dispatches of one sample.
class SampleRecorder {
public:
    SampleRecorder(VkCommandBuffer commands, const TracerState& state, std::uint32_t rows, std::uint32_t sample)
        : commands_(commands), state_(state), lanes_(lanesOf(state.settings.width, rows)), sample_(sample),
          center_(state.settings.spp == 1 ? STEP_CENTER : 0u) {}

    void firstHits() {
        const std::uint32_t bits = STEP_CENTER | STEP_FIRST_HIT;
        run(state_.programs.prepare, 0, bits | STEP_RESET, 1);
        primary(bits);
        for (const Target& target : state_.targets) overRays(target.programs->surface, target.set, 0, bits);
        overRays(state_.programs.shade, state_.set, 0, bits);
    }

    /// Camera rays up to where they ask for light.
    void begin() {
        run(state_.programs.prepare, 0, STEP_RESET, 1);
        primary(center_);
        shade(0, center_);
    }

    /// Pass index, 1 or more: the rays that the pass before has queued.
    void pass(std::uint32_t index) {
        const std::uint32_t queue = index % 2 ? STEP_QUEUE_ONE : 0u;
        // shapes are looked for first, and leave the word that nothing was hit
        const bool shapes = state_.scene->shape_count > 0 || state_.targets.size() != 1;
        if (shapes) overRays(state_.programs.trace_shapes, state_.set, index, queue);
        for (const Target& target : state_.targets)
            overRays(target.programs->trace, target.set, index, queue | (shapes ? 0u : STEP_FRESH));
        shade(index, queue);
    }

private:
    void shade(std::uint32_t index, std::uint32_t bits) {
        for (const Target& target : state_.targets) overRays(target.programs->surface, target.set, index, bits);
        overRays(state_.programs.shade, state_.set, index, bits);
        run(state_.programs.prepare, index, bits, 1);
        if (state_.scene->light_rows.empty()) return;
        overLit(state_.programs.shadow_shapes, state_.set, index, bits);
        if (state_.settings.shadows)
            for (const Target& target : state_.targets) overLit(target.programs->shadow, target.set, index, bits);
        overLit(state_.programs.light, state_.set, index, bits);
        if (state_.caustics.frame.count.x > 0) overLit(state_.programs.caustic, state_.set, index, bits);
    }

    /// First hits of the camera rays.
    void primary(std::uint32_t bits) {
        overRays(state_.programs.trace_shapes, state_.set, 0, bits);
        for (std::size_t i = 0; i < state_.targets.size(); ++i) {
            const Target& target = state_.targets[i];
            if (i > 0) run(state_.programs.prepare, 0, bits | STEP_RESET, 1);
            const std::uint32_t groups = (lanes_ / TILE_PIXELS + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE;
            record(state_.programs.beam, target.set, 0, bits, groups);
            recordIndirect(target.programs->trace_primary, target.set, 0, bits, offsetof(gpu::Control, tile_groups));
        }
    }

    void overRays(const Program& program, VkDescriptorSet set, std::uint32_t pass, std::uint32_t bits) {
        recordIndirect(program, set, pass, bits, offsetof(gpu::Control, ray_groups));
    }

    void overLit(const Program& program, VkDescriptorSet set, std::uint32_t pass, std::uint32_t bits) {
        recordIndirect(program, set, pass, bits, offsetof(gpu::Control, lit_groups));
    }

    void run(const Program& program, std::uint32_t pass, std::uint32_t bits, std::uint32_t groups) {
        record(program, state_.set, pass, bits, groups);
    }

    gpu::PushParams push(std::uint32_t pass, std::uint32_t bits) const { return {{sample_, 0, pass, bits}}; }

    void record(const Program& program, VkDescriptorSet set, std::uint32_t pass, std::uint32_t bits,
                std::uint32_t groups) {
        const gpu::PushParams params = push(pass, bits);
        recordDispatch(commands_, program, set, pushBytes(params), {groups, 1, 1});
        recordBarrier(commands_);
    }

    void recordIndirect(const Program& program, VkDescriptorSet set, std::uint32_t pass, std::uint32_t bits,
                        std::size_t offset) {
        const gpu::PushParams params = push(pass, bits);
        recordDispatchIndirect(commands_, program, set, pushBytes(params), state_.buffers.control, offset);
        recordBarrier(commands_);
    }

    VkCommandBuffer commands_;
    const TracerState& state_;
    std::uint32_t lanes_, sample_, center_;
};

bool showsLight(Integrator integrator) { return integrator != Integrator::kNormal && integrator != Integrator::kDepth; }

gpu::Control readControl(Device& device, const TracerState& state) {
    gpu::Control control{};
    downloadBuffer(device, state.buffers.control, &control, sizeof control);
    return control;
}

/// Traces one sample and adds its counters, which are 32 bits wide on the device and start at 0 with each sample.
void renderSample(Device& device, const TracerState& state, std::uint32_t rows, std::uint32_t sample,
                  RayCounts& counts) {
    std::uint32_t pass = 0;
    gpu::Control control{};
    do { // rays that had to wait, where surfaces reflect and refract, take more passes than a path has bounces
        const VkCommandBuffer commands = beginCommands(device);
        SampleRecorder recorder(commands, state, rows, sample);
        if (pass == 0) {
            if (sample == 0 && state.settings.first_hits) recorder.firstHits();
            recorder.begin();
            pass = 1;
        }
        for (std::uint32_t b = 0; b < state.settings.bounces; ++b) recorder.pass(pass++);
        submitAndWait(device, commands);
        control = readControl(device, state);
    } while (control.queued.x + control.queued.y > 0);
    counts.primary += control.traced.x;
    counts.shadow += control.traced.y;
    counts.secondary += control.traced.z;
}

/// Puts what the film has of a band on the device.
void openBand(Device& device, TracerState& state, const FrameBand& band) {
    gpu::FrameParams params =
        makeFrameParams(*state.scene, state.settings, state.camera, band.band.first_row, band.band.rows);
    params.caustics = state.caustics.frame;
    uploadBuffer(device, state.buffers.params, &params, sizeof params);
    if (band.samples > 0) restoreLight(device, state.buffers, band.band, band.samples, state.result);
}

} // namespace

Tracer createTracer(Device& device, const StagedScene& scene, const RenderSettings& settings, const Camera& camera) {
    Tracer tracer{std::make_shared<TracerState>()};
    TracerState& state = *tracer.state;
    state.settings = settings;
    state.camera = camera;
    state.scene = &scene;
    state.band_rows = std::clamp(kBandPixels / settings.width, 1u, settings.height);
    try {
        state.buffers = createFrameBuffers(device, settings.width, state.band_rows);
        state.programs = createPrograms(device, scene, settings);
        state.caustics = castsCaustics(scene) && showsLight(settings.integrator)
                             ? buildCaustics(device, scene, state.programs, kPhotons)
                             : emptyCaustics(device);
        createBindings(device, state);
    } catch (...) {
        destroyTracer(device, tracer);
        throw;
    }
    return tracer;
}

std::uint64_t deviceBytes(const Tracer& tracer) {
    const CausticMap& caustics = tracer.state->caustics;
    return tracer.state->buffers.device_bytes + caustics.photons.bytes + caustics.buckets.bytes;
}

void destroyTracer(Device& device, Tracer& tracer) {
    if (!tracer.state) return;
    TracerState& state = *tracer.state;
    destroyPrograms(device, state.programs);
    destroyDescriptorPool(device, state.pool);
    destroyFrameBuffers(device, state.buffers);
    destroyCaustics(device, state.caustics);
    tracer.state.reset();
}

RayCounts renderFrame(Device& device, Tracer& tracer, const std::function<void(double)>& progress) {
    FrameJob job;
    job.samples = tracer.state->settings.spp;
    if (progress) job.progress = [&](const FrameState&, double share) { progress(share); };
    RayCounts counts;
    renderUntil(device, tracer, job, nullptr, counts);
    return counts;
}

FrameState renderUntil(Device& device, Tracer& tracer, const FrameJob& job, const Film* start, RayCounts& counts) {
    TracerState& state = *tracer.state;
    const RenderSettings& settings = state.settings;
    if (start)
        state.result = *start;
    else
        allocateFilm(settings, state.result);
    FrameSteps steps;
    steps.open = [&](const FrameBand& band) { openBand(device, state, band); };
    steps.trace = [&](const FrameBand& band) { renderSample(device, state, band.band.rows, band.samples, counts); };
    steps.store = [&](const FrameBand& band, bool was_new) {
        storeLight(device, state.buffers, band.band, band.samples, state.result);
        if (was_new && settings.first_hits)
            storeFirstHits(device, state.buffers, band.band, *state.scene, settings, state.camera, state.result);
    };
    steps.noise = [&] { return relativeNoise(state.result); };
    steps.seconds = [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    };
    return runFrame(job, frameBands(state.result, state.band_rows), steps);
}

const Film& readFilm(const Tracer& tracer) { return tracer.state->result; }

} // namespace pointrt
