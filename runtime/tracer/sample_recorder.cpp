// SPDX-License-Identifier: Apache-2.0
#include "runtime/tracer/sample_recorder.h"

namespace pointrt {

SampleRecorder::SampleRecorder(VkCommandBuffer commands, const BandTracer& tracer, const BandSample& sample)
    : commands_(commands), tracer_(tracer), tiles_(tilesOf(sample.width, sample.rows)), sample_(sample.number),
      center_(sample.at_centers ? STEP_CENTER : 0u), preview_(sample.preview ? STEP_PREVIEW : 0u) {}

void SampleRecorder::firstHits() {
    const std::uint32_t bits = STEP_CENTER | STEP_FIRST_HIT;
    prepare(bits | STEP_RESET);
    primary(bits);
    overRays(tracer_.programs.first_hits, bits);
}

void SampleRecorder::begin() {
    prepare(STEP_RESET);
    primary(center_);
    shade(tracer_.programs.camera.shade, center_);
}

void SampleRecorder::pass(std::uint32_t index) {
    const std::uint32_t queue = index % 2 ? STEP_QUEUE_ONE : 0u;
    const PassPrograms& programs = tracer_.programs.queued;
    overRays(programs.trace_shapes, queue);
    prepare(queue | STEP_ASKED);
    for (const TracerTarget& target : tracer_.targets) {
        overAsked(target.programs->trace, target.sets, queue);
        surface(target.programs->surface, target.sets, queue);
    }
    shade(programs.shade, queue);
}

void SampleRecorder::shade(const Program& program, std::uint32_t bits) {
    const Programs& programs = tracer_.programs;
    overRays(program, bits);
    prepare(bits);
    const auto lights = static_cast<std::uint32_t>(tracer_.scene->light_rows.size());
    if (lights == 0 || !programs.show_light) return;
    // path has one turn, and nothing in a second go
    for (std::uint32_t first = 0; first < lights; first += ASKED_TURNS) shadows(first, bits);
    overLit(programs.light, bits);
    if (tracer_.caustics.frame.count.x > 0) overLit(programs.caustic, bits);
}

/// Which of the lights from first on reach the lit points.
void SampleRecorder::shadows(std::uint32_t first, std::uint32_t bits) {
    first_turn_ = first;
    overLit(tracer_.programs.shadow_shapes, bits);
    if (!tracer_.shadows) return;
    prepare(bits | STEP_ASKED);
    for (const TracerTarget& target : tracer_.targets) overAsked(target.programs->shadow, target.sets, bits);
}

/// First hits of the camera rays.
void SampleRecorder::primary(std::uint32_t bits) {
    overRays(tracer_.programs.camera.trace_shapes, bits);
    for (std::size_t i = 0; i < tracer_.targets.size(); ++i) {
        const TracerTarget& target = tracer_.targets[i];
        if (i > 0) prepare(bits | STEP_RESET);
        record(tracer_.programs.beam, target.sets, bits, (tiles_ + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE);
        recordIndirect(target.programs->trace_primary, target.sets, bits, offsetof(gpu::Control, tile_groups));
        surface(target.programs->camera_surface, target.sets, bits);
    }
}

/// Of what has just been hit: where a later instance is nearer, its own takes the place.
void SampleRecorder::surface(const Program& program, const DescriptorSets& sets, std::uint32_t bits) {
    prepare(bits | STEP_HITS);
    recordIndirect(program, sets, bits, offsetof(gpu::Control, hit_groups));
}

void SampleRecorder::overRays(const Program& program, std::uint32_t bits) {
    recordIndirect(program, tracer_.sets, bits, offsetof(gpu::Control, ray_groups));
}

void SampleRecorder::overLit(const Program& program, std::uint32_t bits) {
    recordIndirect(program, tracer_.sets, bits, offsetof(gpu::Control, light_groups));
}

void SampleRecorder::overAsked(const Program& program, const DescriptorSets& sets, std::uint32_t bits) {
    recordIndirect(program, sets, bits, offsetof(gpu::Control, asked_groups));
}

void SampleRecorder::prepare(std::uint32_t bits) { record(tracer_.programs.prepare, tracer_.sets, bits, 1); }

void SampleRecorder::record(const Program& program, const DescriptorSets& sets, std::uint32_t bits,
                            std::uint32_t groups) {
    const gpu::PushParams params{sample_, first_turn_, bits | preview_, 0};
    recordDispatch(commands_, program, sets, pushBytes(params), {groups, 1, 1});
    recordBarrier(commands_);
}

void SampleRecorder::recordIndirect(const Program& program, const DescriptorSets& sets, std::uint32_t bits,
                                    std::size_t offset) {
    const gpu::PushParams params{sample_, first_turn_, bits | preview_, 0};
    recordDispatchIndirect(commands_, program, sets, pushBytes(params), tracer_.buffers.control, offset);
    recordBarrier(commands_);
}

} // namespace pointrt
