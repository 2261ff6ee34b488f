// SPDX-License-Identifier: Apache-2.0
#include "runtime/sample_recorder.h"

namespace pointrt {

SampleRecorder::SampleRecorder(VkCommandBuffer commands, const BandTracer& tracer, const BandSample& sample)
    : commands_(commands), tracer_(tracer), tiles_(tilesOf(sample.width, sample.rows)), sample_(sample.number),
      center_(sample.at_centers ? STEP_CENTER : 0u), steady_(sample.steady ? STEP_STEADY : 0u) {}

void SampleRecorder::firstHits() {
    const std::uint32_t bits = STEP_CENTER | STEP_FIRST_HIT;
    run(tracer_.programs.prepare, 0, bits | STEP_RESET, 1);
    primary(bits);
    for (const TracerTarget& target : tracer_.targets) overRays(target.programs->surface, target.set, 0, bits);
    overRays(tracer_.programs.shade, tracer_.set, 0, bits);
}

void SampleRecorder::begin() {
    run(tracer_.programs.prepare, 0, STEP_RESET, 1);
    primary(center_);
    shade(0, center_);
}

void SampleRecorder::pass(std::uint32_t index) {
    const std::uint32_t queue = index % 2 ? STEP_QUEUE_ONE : 0u;
    // shapes are looked for first, and leave the word that nothing was hit
    const bool shapes = tracer_.scene->shape_count > 0 || tracer_.targets.size() != 1;
    if (shapes) overRays(tracer_.programs.trace_shapes, tracer_.set, index, queue);
    for (const TracerTarget& target : tracer_.targets)
        overRays(target.programs->trace, target.set, index, queue | (shapes ? 0u : STEP_FRESH));
    shade(index, queue);
}

void SampleRecorder::shade(std::uint32_t index, std::uint32_t bits) {
    const Programs& programs = tracer_.programs;
    for (const TracerTarget& target : tracer_.targets) overRays(target.programs->surface, target.set, index, bits);
    overRays(programs.shade, tracer_.set, index, bits);
    run(programs.prepare, index, bits, 1);
    if (tracer_.scene->light_rows.empty()) return;
    overLit(programs.shadow_shapes, tracer_.set, index, bits);
    if (tracer_.shadows)
        for (const TracerTarget& target : tracer_.targets) overLit(target.programs->shadow, target.set, index, bits);
    overLit(programs.light, tracer_.set, index, bits);
    if (tracer_.caustics.frame.count.x > 0) overLit(programs.caustic, tracer_.set, index, bits);
}

/// First hits of the camera rays.
void SampleRecorder::primary(std::uint32_t bits) {
    overRays(tracer_.programs.trace_shapes, tracer_.set, 0, bits);
    for (std::size_t i = 0; i < tracer_.targets.size(); ++i) {
        const TracerTarget& target = tracer_.targets[i];
        if (i > 0) run(tracer_.programs.prepare, 0, bits | STEP_RESET, 1);
        record(tracer_.programs.beam, target.set, 0, bits, (tiles_ + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE);
        recordIndirect(target.programs->trace_primary, target.set, 0, bits, offsetof(gpu::Control, tile_groups));
    }
}

void SampleRecorder::overRays(const Program& program, VkDescriptorSet set, std::uint32_t pass, std::uint32_t bits) {
    recordIndirect(program, set, pass, bits, offsetof(gpu::Control, ray_groups));
}

void SampleRecorder::overLit(const Program& program, VkDescriptorSet set, std::uint32_t pass, std::uint32_t bits) {
    recordIndirect(program, set, pass, bits, offsetof(gpu::Control, lit_groups));
}

void SampleRecorder::run(const Program& program, std::uint32_t pass, std::uint32_t bits, std::uint32_t groups) {
    record(program, tracer_.set, pass, bits, groups);
}

void SampleRecorder::record(const Program& program, VkDescriptorSet set, std::uint32_t pass, std::uint32_t bits,
                            std::uint32_t groups) {
    const gpu::PushParams params{{sample_, 0, pass, bits | steady_}};
    recordDispatch(commands_, program, set, pushBytes(params), {groups, 1, 1});
    recordBarrier(commands_);
}

void SampleRecorder::recordIndirect(const Program& program, VkDescriptorSet set, std::uint32_t pass, std::uint32_t bits,
                                    std::size_t offset) {
    const gpu::PushParams params{{sample_, 0, pass, bits | steady_}};
    recordDispatchIndirect(commands_, program, set, pushBytes(params), tracer_.buffers.control, offset);
    recordBarrier(commands_);
}

} // namespace pointrt
