// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/sample_recorder.h"

namespace pointrt {

SampleRecorder::SampleRecorder(PassCommands& commands, const BandTracer& tracer, const BandSample& sample)
    : commands_(commands), tracer_(tracer), tiles_(tilesOf(sample.width, sample.rows)), sample_(sample.number),
      center_(sample.at_centers ? STEP_CENTER : 0u), preview_(sample.preview ? STEP_PREVIEW : 0u),
      places_(sample.at_places ? STEP_PLACES : 0u), keeps_hits_(sample.at_places && sample.first_hits) {}

void SampleRecorder::firstHits() {
    const std::uint32_t bits = STEP_CENTER | (places_ ? 0u : STEP_FIRST_HIT);
    prepare(bits | STEP_RESET);
    primary(bits);
    run(tracer_.programs.first_hits, tracer_.targets.sets, bits, rays_);
}

void SampleRecorder::begin() {
    prepare(STEP_RESET);
    primary(center_);
    if (keeps_hits_) run(tracer_.programs.first_hits, tracer_.targets.sets, center_, rays_);
    if (tracer_.programs.form == PassForm::kFused)
        follow(tracer_.programs.camera.follow, center_);
    else
        shade(tracer_.programs.camera.shade, center_);
}

void SampleRecorder::pass(std::uint32_t index) {
    const std::uint32_t queue = index % 2 ? STEP_QUEUE_ONE : 0u;
    rays_ = index % 2 ? PassLanes::kQueueOne : PassLanes::kQueueZero;
    const PassPrograms& programs = tracer_.programs.queued;
    if (tracer_.programs.form == PassForm::kFused) {
        askInstances(queue);
        return follow(programs.follow, queue);
    }
    run(programs.trace_shapes, tracer_.targets.sets, queue, rays_);
    prepareList(LIST_ASKED, queue);
    askInstances(queue);
    shade(programs.shade, queue);
}

/// What the rays listed for them hit.
void SampleRecorder::askInstances(std::uint32_t bits) {
    const TracerTarget* const first = tracer_.targets.each.data();
    askAll(LIST_ASKED, &SievePrograms::asked, bits, [&](const TracerTarget& target, std::uint32_t list) {
        runOver(list, target.programs->trace, target.sets, bits);
        surface(target.programs->surface, target.sets, bits);
        if (tracer_.hit_counts) commands_.copyHitCount(*tracer_.hit_counts, static_cast<std::size_t>(&target - first));
    });
}

/// The fused form's shade: on to where instances are to be asked, at once for the light that is waiting.
void SampleRecorder::follow(const Program& program, std::uint32_t bits) {
    const Programs& programs = tracer_.programs;
    run(program, tracer_.targets.sets, bits, rays_);
    prepare(bits);
    prepareList(LIST_ASKED, bits);
    if (!programs.light_on_the_way) return light(bits);
    if (!tracer_.shadows || tracer_.targets.each.empty()) return;
    if (programs.asks_one) return shadowLight(bits);
    askForShadows(bits);
    runOver(LIST_LIT, programs.light, tracer_.targets.sets, bits);
}

/// Brings the light of shadow rays that no instance stops.
void SampleRecorder::shadowLight(std::uint32_t bits) {
    const Targets& targets = tracer_.targets;
    const bool sifted = !targets.sieves.empty(); // then which target asks a ray last is not known
    askAll(LIST_LIT, &SievePrograms::shadow_rays, bits, [&](const TracerTarget& target, std::uint32_t list) {
        const std::uint32_t last = !sifted && &target == &targets.each.back() ? STEP_LAST : 0u;
        runOver(list, target.programs->shadow_light, target.sets, bits | last);
    });
    if (sifted) runOver(LIST_LIT, tracer_.programs.bring, targets.sets, bits);
}

void SampleRecorder::shade(const Program& program, std::uint32_t bits) {
    run(program, tracer_.targets.sets, bits, rays_);
    prepare(bits);
    if (tracer_.programs.show_light) light(bits);
}

/// Of all lights that reach the points listed, or of one of them.
void SampleRecorder::light(std::uint32_t bits) {
    const Programs& programs = tracer_.programs;
    const auto lights = static_cast<std::uint32_t>(tracer_.scene->light_rows.size());
    if (lights == 0) return;
    // path has one turn, and nothing in a second go
    for (std::uint32_t first = 0; first < lights; first += ASKED_TURNS) shadows(first, bits);
    runOver(LIST_LIT, programs.light, tracer_.targets.sets, bits);
    if (shownMap(tracer_.caustics).frame.count.x > 0) runOver(LIST_LIT, programs.caustic, tracer_.targets.sets, bits);
}

/// Which of the lights from first on reach the lit points.
void SampleRecorder::shadows(std::uint32_t first, std::uint32_t bits) {
    first_turn_ = first;
    runOver(LIST_LIT, tracer_.programs.shadow_shapes, tracer_.targets.sets, bits);
    if (tracer_.shadows) askForShadows(bits);
}

/// Which of the shadow rays listed for them instances stop.
void SampleRecorder::askForShadows(std::uint32_t bits) {
    prepareList(LIST_TURNS, bits);
    askAll(LIST_TURNS, &SievePrograms::turns, bits, [&](const TracerTarget& target, std::uint32_t list) {
        runOver(list, target.programs->shadow, target.sets, bits);
    });
}

/// First hits of the camera rays.
void SampleRecorder::primary(std::uint32_t bits) {
    run(tracer_.programs.camera.trace_shapes, tracer_.targets.sets, bits, rays_);
    for (std::size_t i = 0; i < tracer_.targets.each.size(); ++i) {
        const TracerTarget& target = tracer_.targets.each[i];
        if (i > 0) prepare(bits | STEP_RESET);
        run(tracer_.programs.beam, target.sets, bits, PassLanes::kTiles,
            (tiles_ + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE);
        run(target.programs->trace_primary, target.sets, bits, PassLanes::kTilesLeft);
        surface(target.programs->camera_surface, target.sets, bits);
    }
}

/// Of what has just been hit: where a later instance is nearer, its own takes the place.
void SampleRecorder::surface(const Program& program, const DescriptorSets& sets, std::uint32_t bits) {
    prepare(bits | STEP_HITS);
    run(program, sets, bits, PassLanes::kHits);
}

void SampleRecorder::prepare(std::uint32_t bits) {
    run(tracer_.programs.prepare, tracer_.targets.sets, bits, PassLanes::kOne, 1);
}

/// What was appended to a list is its own.
void SampleRecorder::prepareList(std::uint32_t list, std::uint32_t bits) {
    const gpu::PushParams params = pushed(bits | STEP_LIST, list);
    commands_.run({tracer_.programs.prepare, tracer_.targets.sets, pushBytes(params), PassLanes::kOne, 1});
}

void SampleRecorder::askAll(std::uint32_t list, Program SievePrograms::*sift, std::uint32_t bits,
                            const AskTarget& ask) {
    askTargets(commands_, tracer_.programs, tracer_.targets, {list, sift, pushed(bits)}, ask);
}

void SampleRecorder::run(const Program& program, const DescriptorSets& sets, std::uint32_t bits, PassLanes lanes,
                         std::uint32_t groups) {
    const gpu::PushParams params = pushed(bits);
    commands_.run({program, sets, pushBytes(params), lanes, groups});
}

void SampleRecorder::runOver(std::uint32_t list, const Program& program, const DescriptorSets& sets,
                             std::uint32_t bits) {
    const gpu::PushParams params = pushed(bits, list);
    commands_.run({program, sets, pushBytes(params), PassLanes::kList, 0, list});
}

gpu::PushParams SampleRecorder::pushed(std::uint32_t bits, std::uint32_t list) const {
    return {sample_, first_turn_, bits | preview_ | places_, list};
}

} // namespace pointrt
