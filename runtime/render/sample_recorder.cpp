// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/sample_recorder.h"

#include <algorithm>
#include <string>
#include <utility>

namespace pointrt {
namespace {

/// Largest number of rounds that composite Gaussians. With several instances, a round composites WAITING_GAUSSIANS for
/// each ray; all rounds together composite 640, beyond which hardly any ray has light left. With a single instance, a
/// round ends where lavapipe ends its loops, after 65,535 iterations, which is some hundreds of Gaussians.
constexpr std::uint32_t kMostRounds = 64;

/// The two lists in turn: a round reads one, and lists the rays that it leaves unfinished in the other.
constexpr std::uint32_t kRoundLists[] = {LIST_SHADOW_RAYS, LIST_DIRECT_LIGHT};

/// Squared distance from a point of render space to the middle of an instance's cube.
double squaredDistanceTo(const gpu::InstanceParams& params, const gpu::vec3& point) {
    const auto coordinate = [&](const gpu::vec4& row) {
        return double{row.x} * point.x + double{row.y} * point.y + double{row.z} * point.z + row.w - 0.5;
    };
    const double x = coordinate(params.row_x), y = coordinate(params.row_y), z = coordinate(params.row_z);
    return (x * x + y * y + z * z) / (double{params.splat.w} * params.splat.w);
}

/// The instances of Gaussians, those near the eye first: they soon fill the waiting slots, so that the walks of those
/// behind end early.
std::vector<const TracedInstance*> gaussiansFrom(const gpu::vec3& eye, const BandTracer& tracer) {
    const auto distanceTo = [&](const TracedInstance* each) {
        return squaredDistanceTo(tracer.scene->instances[each->places.front()].params, eye);
    };
    std::vector<const TracedInstance*> gaussians;
    for (const TracedInstance& each : tracer.instances.each)
        if (each.is_gaussian) gaussians.push_back(&each);
    std::stable_sort(gaussians.begin(), gaussians.end(),
                     [&](const auto* a, const auto* b) { return distanceTo(a) < distanceTo(b); });
    return gaussians;
}

} // namespace

SampleRecorder::SampleRecorder(PassCommands& commands, const BandTracer& tracer, const BandSample& sample)
    : commands_(commands), tracer_(tracer), tiles_(tilesOf(sample.width, sample.rows)), sample_(sample.number),
      center_(sample.at_centers ? STEP_CENTER : 0u), preview_(sample.preview ? STEP_PREVIEW : 0u),
      pixel_list_(sample.at_listed_pixels ? STEP_PIXEL_LIST : 0u), has_gaussians_(hasGaussians(*tracer.scene)),
      gaussians_(gaussiansFrom(sample.params.eye, tracer)),
      stores_first_hits_(sample.at_listed_pixels && sample.first_hits) {}

void SampleRecorder::firstHits() {
    const CommandLabel label = commands_.label("first hits");
    const std::uint32_t bits = STEP_CENTER | (pixel_list_ ? 0u : STEP_FIRST_HIT);
    prepare(bits | STEP_RESET);
    intersectCamera(bits);
    run(tracer_.programs.first_hits, tracer_.instances.sets, bits, rays_);
    gaussianFirstHits(bits);
}

void SampleRecorder::begin() {
    const CommandLabel label = commands_.label("camera rays");
    prepare(STEP_RESET);
    if (sample_ > 0 && sample_ % FILM_BATCH == 0) run(tracer_.programs.fold_film, tracer_.instances.sets, 0, rays_);
    intersectCamera(center_);
    if (stores_first_hits_) {
        run(tracer_.programs.first_hits, tracer_.instances.sets, center_, rays_);
        gaussianFirstHits(center_);
    }
    compositeCamera(center_);
    catchShadows(tracer_.programs.camera.query_shadow_catcher, center_);
    if (tracer_.programs.form == KernelForm::kMegakernel)
        megakernel(tracer_.programs.camera.megakernel, center_);
    else
        shadeSurface(tracer_.programs.camera.shade_surface, center_);
}

void SampleRecorder::pass(std::uint32_t index) {
    const CommandLabel label = commands_.label(("bounce " + std::to_string(index)).c_str());
    const std::uint32_t queue = index % 2 ? STEP_QUEUE_ONE : 0u;
    rays_ = index % 2 ? PassLanes::kQueueOne : PassLanes::kQueueZero;
    const PassPrograms& programs = tracer_.programs.queued;
    if (tracer_.programs.form == KernelForm::kMegakernel) {
        intersectClosest(queue);
        compositeQueued(queue);
        catchShadows(programs.query_shadow_catcher, queue);
        // deferred rays have scattered fewer times than the number of passes
        const bool may_add_direct = index <= 1 || tracer_.programs.defers_rays || !tracer_.programs.one_bounce;
        return megakernel(programs.megakernel, queue | (may_add_direct ? STEP_DIRECT : 0u));
    }
    run(programs.intersect_shapes, tracer_.instances.sets, queue, rays_);
    closeList(LIST_INSTANCE_RAYS, queue);
    intersectClosest(queue);
    compositeQueued(queue);
    catchShadows(programs.query_shadow_catcher, queue);
    shadeSurface(programs.shade_surface, queue);
}

/// Closest hits of the camera rays, on shapes and then on each instance.
void SampleRecorder::intersectCamera(std::uint32_t bits) {
    const std::vector<TracedInstance>& instances = tracer_.instances.each;
    const bool beam_follows =
        std::any_of(instances.begin(), instances.end(), [](const TracedInstance& each) { return !each.is_gaussian; });
    const gpu::PushParams params = pushed(bits);
    commands_.run({tracer_.programs.camera.intersect_shapes, tracer_.instances.sets, pushBytes(params), rays_, 0, 0,
                   beam_follows});
    bool is_first = true;
    for (const TracedInstance& instance : instances) {
        if (instance.is_gaussian) continue;
        if (!std::exchange(is_first, false)) prepare(bits | STEP_RESET);
        const Program& beam = instance.programs->beam.pipeline ? instance.programs->beam : tracer_.programs.beam;
        run(beam, instance.sets, bits, PassLanes::kTiles,
            (tiles_ * instance.beams + WORKGROUP_SIZE - 1) / WORKGROUP_SIZE);
        run(instance.programs->intersect_camera, instance.sets, bits, PassLanes::kTilesLeft);
        run(instance.programs->camera_surface, instance.sets, bits, PassLanes::kHits);
    }
}

/// Closest hits of the listed rays on all instances, and their surface interactions, which nearer hits on later
/// instances overwrite.
void SampleRecorder::intersectClosest(std::uint32_t bits) {
    const std::uint32_t counting = tracer_.hit_counts ? STEP_COUNT_HITS : 0u;
    bool is_first = true;
    intersectAll(LIST_INSTANCE_RAYS, &CullPrograms::closest, bits,
                 [&](const TracedInstance& instance, std::uint32_t list) {
                     if (!std::exchange(is_first, false)) prepare(bits | STEP_HITS);
                     runOver(list, instance.programs->intersect_closest, instance.sets, bits | counting);
                     run(instance.programs->surface, instance.sets, bits, PassLanes::kHits);
                     if (tracer_.hit_counts) commands_.copyHitCounts(*tracer_.hit_counts, instance.places);
                 });
}

void SampleRecorder::gaussianFirstHits(std::uint32_t bits) {
    const Program& blend = tracer_.programs.blend_first_hits;
    compositeGaussians(
        {&InstancePrograms::gaussian_first_hits, &InstancePrograms::gather_camera, blend, STEP_FIRST_HITS}, bits);
}

void SampleRecorder::compositeCamera(std::uint32_t bits) {
    const Program& blend = tracer_.programs.camera.blend_gaussians;
    compositeGaussians({&InstancePrograms::composite_camera, &InstancePrograms::gather_camera, blend}, bits);
}

void SampleRecorder::compositeQueued(std::uint32_t bits) {
    const Program& blend = tracer_.programs.queued.blend_gaussians;
    compositeGaussians({&InstancePrograms::composite, &InstancePrograms::gather, blend}, bits);
}

/// The light of Gaussians in front of the closest hits of the current rays. Gaussians of a single instance are
/// composited during its walk, with further rounds for rays whose loops lavapipe ended; those of several instances are
/// composited in rounds.
void SampleRecorder::compositeGaussians(const GaussianPass& pass, std::uint32_t bits) {
    if (!has_gaussians_) return;
    const std::uint32_t rounds = roundsOf(pass);
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const std::uint32_t step = bits | (round + 1 == rounds ? STEP_FINAL : 0u);
        if (tracer_.programs.merges_gaussians)
            gatherRound(pass, round, step);
        else
            compositeRound(pass, round, step);
        closeList(kRoundLists[(round + 1) % 2], bits);
    }
}

/// First hits on a single instance take one round: rays end where half of the light is hidden.
std::uint32_t SampleRecorder::roundsOf(const GaussianPass& pass) const {
    if (tracer_.programs.merges_gaussians) return kMostRounds;
    return tracer_.programs.cuts_loops && !(pass.bits & STEP_FIRST_HITS) ? kMostRounds : 1;
}

/// Runs a program in a round: in the first over the current rays, then over those that the round before listed.
void SampleRecorder::runRound(const Program& program, const DescriptorSets& sets, std::uint32_t round,
                              std::uint32_t bits) {
    const std::uint32_t list = kRoundLists[round % 2];
    const gpu::PushParams params = pushed(bits | (round > 0 ? STEP_RESUME : 0u), list);
    commands_.run({program, sets, pushBytes(params), round > 0 ? PassLanes::kList : rays_, 0, list});
}

/// One round for the only instance of Gaussians.
void SampleRecorder::compositeRound(const GaussianPass& pass, std::uint32_t round, std::uint32_t bits) {
    for (const TracedInstance* instance : gaussians_)
        runRound(instance->programs->*pass.composite, instance->sets, round, bits | STEP_FIRST | STEP_LAST);
}

/// One round for all instances of Gaussians.
void SampleRecorder::gatherRound(const GaussianPass& pass, std::uint32_t round, std::uint32_t bits) {
    bool is_first = true;
    for (const TracedInstance* instance : gaussians_)
        runRound(instance->programs->*pass.gather, instance->sets, round,
                 bits | pass.bits | (std::exchange(is_first, false) ? STEP_FIRST : 0u));
    runRound(pass.blend, tracer_.instances.sets, round, bits);
}

/// Shadows of surfaces on Gaussian captures. The shadows that Gaussians cast on each other are part of the capture,
/// unless they are lit: then this pass shades them.
void SampleRecorder::catchShadows(const Program& query, std::uint32_t bits) {
    const DeviceScene& scene = *tracer_.scene;
    const auto lights = static_cast<std::uint32_t>(scene.light_rows.size());
    const std::vector<TracedInstance>& instances = tracer_.instances.each;
    const bool has_surfaces =
        !scene.shape_rows.empty() ||
        std::any_of(instances.begin(), instances.end(), [](const TracedInstance& each) { return !each.is_gaussian; });
    const bool has_shadows = tracer_.shadows && lights > 0 && has_surfaces, relights = tracer_.programs.relights;
    if (!tracer_.programs.catches_shadows || !(has_shadows || relights)) return;
    run(query, tracer_.instances.sets, bits, rays_);
    closeList(LIST_DIRECT_LIGHT, bits);
    const Attenuation attenuation = relights ? Attenuation::kByGaussians : Attenuation::kNone;
    for (std::uint32_t first = 0; first < lights; first += SHADOW_RAYS_PER_PATH) shadows(first, bits, attenuation);
    runOver(LIST_DIRECT_LIGHT, tracer_.programs.shade_shadow_catcher, tracer_.instances.sets, bits);
}

/// The transmittance of Gaussians along the shadow rays of a closed list.
void SampleRecorder::attenuateShadows(std::uint32_t list, Program InstancePrograms::*program, std::uint32_t bits) {
    if (!has_gaussians_) return;
    for (const TracedInstance* instance : gaussians_) runOver(list, instance->programs->*program, instance->sets, bits);
}

void SampleRecorder::shadeSurface(const Program& program, std::uint32_t bits) {
    run(program, tracer_.instances.sets, bits, rays_);
    prepare(bits);
    if (tracer_.programs.has_direct_lighting) directLight(bits);
}

/// Follows paths up to where they need instances, and tests the occlusion of their shadow rays by instances.
void SampleRecorder::megakernel(const Program& program, std::uint32_t bits) {
    const Programs& programs = tracer_.programs;
    run(program, tracer_.instances.sets, bits, rays_);
    prepare(bits);
    if (!programs.inline_nee) return directLight(bits);
    if (!tracer_.shadows || tracer_.instances.each.empty()) return;
    if (programs.samples_one_light) return intersectShadowRay(bits);
    intersectShadow(bits, Attenuation::kByGaussians);
    runOver(LIST_DIRECT_LIGHT, programs.shade_shadow, tracer_.instances.sets, bits);
}

/// Direct light and caustics of the queries of LIST_DIRECT_LIGHT.
void SampleRecorder::directLight(std::uint32_t bits) {
    const Programs& programs = tracer_.programs;
    const auto lights = static_cast<std::uint32_t>(tracer_.scene->light_rows.size());
    if (lights == 0) return;
    // with stored shadow rays, a path has one light sample, and none in further iterations
    for (std::uint32_t first = 0; first < lights; first += SHADOW_RAYS_PER_PATH)
        shadows(first, bits, Attenuation::kByGaussians);
    runOver(LIST_DIRECT_LIGHT, programs.shade_shadow, tracer_.instances.sets, bits);
    if (shownMap(tracer_.caustics).frame.count.x > 0)
        runOver(LIST_DIRECT_LIGHT, programs.caustic, tracer_.instances.sets, bits);
}

/// Occlusion of SHADOW_RAYS_PER_PATH light samples from first on.
void SampleRecorder::shadows(std::uint32_t first, std::uint32_t bits, Attenuation attenuation) {
    first_light_sample_ = first;
    runOver(LIST_DIRECT_LIGHT, tracer_.programs.intersect_shadow_shapes, tracer_.instances.sets, bits);
    if (!tracer_.shadows) return;
    closeList(LIST_SHADOW_RAYS, bits);
    intersectShadow(bits, attenuation);
}

/// Occlusion by instances of the queued shadow rays.
void SampleRecorder::intersectShadow(std::uint32_t bits, Attenuation attenuation) {
    if (attenuation == Attenuation::kByGaussians)
        attenuateShadows(LIST_SHADOW_RAYS, &InstancePrograms::attenuate_shadow, bits);
    intersectAll(LIST_SHADOW_RAYS, &CullPrograms::shadow, bits,
                 [&](const TracedInstance& instance, std::uint32_t list) {
                     runOver(list, instance.programs->intersect_shadow, instance.sets, bits);
                 });
}

/// The same for the megakernel's stored shadow rays; accumulates the unoccluded ones.
void SampleRecorder::intersectShadowRay(std::uint32_t bits) {
    const TracedInstances& instances = tracer_.instances;
    // after culling, the last instance of a ray is unknown, and may hold Gaussians
    const bool separately = !instances.cull_groups.empty() || has_gaussians_;
    attenuateShadows(LIST_DIRECT_LIGHT, &InstancePrograms::attenuate_shadow_ray, bits);
    intersectAll(LIST_DIRECT_LIGHT, &CullPrograms::shadow_ray, bits,
                 [&](const TracedInstance& instance, std::uint32_t list) {
                     const std::uint32_t last = !separately && &instance == &instances.each.back() ? STEP_LAST : 0u;
                     runOver(list, instance.programs->intersect_shadow_ray, instance.sets, bits | last);
                 });
    if (separately) runOver(LIST_DIRECT_LIGHT, tracer_.programs.accumulate_shadow, instances.sets, bits);
}

void SampleRecorder::prepare(std::uint32_t bits) {
    run(tracer_.programs.prepare, tracer_.instances.sets, bits, PassLanes::kOne, 1);
}

/// Makes the entries appended to a list the list's contents.
void SampleRecorder::closeList(std::uint32_t list, std::uint32_t bits) {
    const gpu::PushParams params = pushed(bits | STEP_LIST, list);
    commands_.run({tracer_.programs.prepare, tracer_.instances.sets, pushBytes(params), PassLanes::kOne, 1});
}

void SampleRecorder::intersectAll(std::uint32_t list, Program CullPrograms::*cull, std::uint32_t bits,
                                  const IntersectInstance& intersect) {
    intersectInstances(commands_, tracer_.programs, tracer_.instances, {list, cull, pushed(bits)}, intersect);
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
    return {sample_, first_light_sample_, bits | preview_ | pixel_list_, list};
}

} // namespace pointrt
