// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/programs.h"

#include <algorithm>
#include <span>
#include <vector>

#include "format/base/parallel.h"
#include "runtime/device_scene/scene_rows.h"
#include "runtime/render/caustic_map.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/render/instance_culling.h"
#include "runtime/render/pooled_tiles.h"
#include "runtime/util/on_error.h"
#include "shaders/accumulate_shadow.spv.h"
#include "shaders/attenuate_shadow.spv.h"
#include "shaders/attenuate_shadow_paged.spv.h"
#include "shaders/attenuate_shadow_ray.spv.h"
#include "shaders/attenuate_shadow_ray_paged.spv.h"
#include "shaders/beam.spv.h"
#include "shaders/beam_pooled.spv.h"
#include "shaders/blend_first_hits.spv.h"
#include "shaders/blend_gaussians.spv.h"
#include "shaders/caustic.spv.h"
#include "shaders/compact.spv.h"
#include "shaders/composite_gaussians.spv.h"
#include "shaders/composite_gaussians_paged.spv.h"
#include "shaders/cull_closest.spv.h"
#include "shaders/cull_shadow.spv.h"
#include "shaders/cull_shadow_ray.spv.h"
#include "shaders/first_hits.spv.h"
#include "shaders/fold_film.spv.h"
#include "shaders/gather_gaussians.spv.h"
#include "shaders/gather_gaussians_paged.spv.h"
#include "shaders/gaussian_first_hits.spv.h"
#include "shaders/gaussian_first_hits_paged.spv.h"
#include "shaders/intersect_camera.spv.h"
#include "shaders/intersect_camera_hardware.spv.h"
#include "shaders/intersect_camera_paged.spv.h"
#include "shaders/intersect_camera_pooled.spv.h"
#include "shaders/intersect_closest.spv.h"
#include "shaders/intersect_closest_hardware.spv.h"
#include "shaders/intersect_closest_paged.spv.h"
#include "shaders/intersect_closest_pooled.spv.h"
#include "shaders/intersect_shadow.spv.h"
#include "shaders/intersect_shadow_hardware.spv.h"
#include "shaders/intersect_shadow_paged.spv.h"
#include "shaders/intersect_shadow_pooled.spv.h"
#include "shaders/intersect_shadow_ray.spv.h"
#include "shaders/intersect_shadow_ray_hardware.spv.h"
#include "shaders/intersect_shadow_ray_paged.spv.h"
#include "shaders/intersect_shadow_ray_pooled.spv.h"
#include "shaders/intersect_shadow_shapes.spv.h"
#include "shaders/intersect_shapes.spv.h"
#include "shaders/intersect_shapes_camera.spv.h"
#include "shaders/megakernel.spv.h"
#include "shaders/photon.spv.h"
#include "shaders/prepare.spv.h"
#include "shaders/query_shadow_catcher.spv.h"
#include "shaders/shade_shadow.spv.h"
#include "shaders/shade_shadow_catcher.spv.h"
#include "shaders/shade_surface.spv.h"
#include "shaders/surface.spv.h"
#include "shaders/surface_paged.spv.h"
#include "shaders/surface_pooled.spv.h"

namespace pointrt {

namespace {

using gpu::uint; // the masks of FEATURE_* cast to it

/// Values of the specialization constants.
struct Constants {
    InstanceTraits instance;
    std::uint32_t sky_image = 0, integrator = 0, features = 0, camera_pass = 0, gathers_photons = 0, shape_kinds = 0;
    std::uint32_t cull_boxes = 0, one_bounce = 0, panorama_eyes = 0;
};

std::vector<SpecConstant> listed(const Constants& c) {
    std::vector<SpecConstant> values = traitConstants(c.instance);
    values.insert(values.end(), {{SPEC_SKY_IMAGE, c.sky_image},
                                 {SPEC_INTEGRATOR, c.integrator},
                                 {SPEC_FEATURES, c.features},
                                 {SPEC_CAMERA_PASS, c.camera_pass},
                                 {SPEC_GATHERS_PHOTONS, c.gathers_photons},
                                 {SPEC_SHAPE_KINDS, c.shape_kinds},
                                 {SPEC_CULL_BOXES, c.cull_boxes},
                                 {SPEC_ONE_BOUNCE, c.one_bounce},
                                 {SPEC_PANORAMA_EYES, c.panorama_eyes}});
    return values;
}

/// A program to build.
struct Order {
    Program* program = nullptr;
    const char* name = "";
    std::span<const std::uint32_t> spirv;
    Constants constants;
};

void build(Device& device, const Order& order) {
    *order.program =
        createProgram(device, order.name, order.spirv, std::span<const SpecConstant>(listed(order.constants)));
}

bool isCpu(const Device& device) { return device.type == VK_PHYSICAL_DEVICE_TYPE_CPU; }
bool tracesOneBounce(const Device& device) { return !isCpu(device); }

Constants constantsFor(const Device& device, const DeviceScene& scene, const RenderSettings& settings) {
    Constants constants;
    constants.one_bounce = tracesOneBounce(device);
    if (settings.camera.panorama) constants.panorama_eyes = settings.camera.eyes_apart_m > 0 ? 2 : 1;
    constants.sky_image = scene.sky_light != NO_LIGHT;
    constants.integrator = static_cast<std::uint32_t>(settings.integrator);
    constants.features = scene.features;
    constants.shape_kinds = shapeKinds(scene.shape_rows);
    constants.gathers_photons = castsCaustics(scene) && usesLights(settings.integrator);
    // beam is shared by all instances; for whole files the core is the whole grid
    constants.instance.clips_to_core = !scene.sets.empty();
    constants.instance.reads_storage =
        device.type != VK_PHYSICAL_DEVICE_TYPE_CPU &&
        std::all_of(scene.files.begin(), scene.files.end(), [](const DeviceScan& each) { return each.reads_storage; });
    return constants;
}

#define POINTRT_REFRACTS(number, NAME, Name, word, label, lobes, traits)                                               \
    | (((traits)&MATERIAL_REFRACTS) != 0u ? FEATURE_MATERIAL(number) : 0u)
constexpr std::uint32_t kRefracts = 0u MATERIALS(POINTRT_REFRACTS);
#undef POINTRT_REFRACTS

/// Must agree with kMayDefer in shaders/shade/continue_path.glsl.
bool mayDefer(const DeviceScene& scene, Integrator integrator) {
    return (scene.features & kRefracts) != 0 && !hasTrait(integrator, INTEGRATOR_IS_STOCHASTIC);
}

/// Whether programs store shadow rays with their contributions: megakernels that sample one light do.
bool storesShadowRays(const Programs& all) { return all.form == KernelForm::kMegakernel && all.samples_one_light; }

/// Whether programs queue shadow rays: all others do, and so do shadow catchers.
bool queuesShadowRays(const Programs& all) {
    return all.catches_shadows || (all.has_direct_lighting && !storesShadowRays(all));
}

/// Appends orders for the programs that trace the tiles in a block.
void orderPooled(Constants constants, const Programs& all, InstancePrograms& programs, std::vector<Order>& orders) {
    constants.cull_boxes = constants.instance.pooled_tiles;
    const auto order = [&](Program& program, const char* name, std::span<const std::uint32_t> spirv) {
        orders.push_back({&program, name, spirv, constants});
    };
    order(programs.beam, "beam (pooled)", beam_pooled_spv);
    order(programs.intersect_camera, "intersect_camera (pooled)", intersect_camera_pooled_spv);
    if (storesShadowRays(all))
        order(programs.intersect_shadow_ray, "intersect_shadow_ray (pooled)", intersect_shadow_ray_pooled_spv);
    if (queuesShadowRays(all))
        order(programs.intersect_shadow, "intersect_shadow (pooled)", intersect_shadow_pooled_spv);
    if (all.has_secondary_rays) {
        order(programs.intersect_closest, "intersect_closest (pooled)", intersect_closest_pooled_spv);
        order(programs.surface, "surface (pooled)", surface_pooled_spv);
    }
    constants.camera_pass = 1;
    order(programs.camera_surface, "surface (camera, pooled)", surface_pooled_spv);
}

void orderFor(const InstanceTraits& instance, Constants constants, const Programs& all, InstancePrograms& programs,
              std::vector<Order>& orders) {
    constants.instance = instance;
    const bool paged = isPaged(instance.pages);
    const auto order = [&](Program& program, const char* name, std::span<const std::uint32_t> plain,
                           std::span<const std::uint32_t> with_pages, bool of_camera = false) {
        constants.camera_pass = of_camera;
        orders.push_back({&program, name, paged ? with_pages : plain, constants});
    };
    const auto orderComposite = [&] {
        if (all.merges_gaussians) {
            order(programs.gather_camera, "gather_gaussians (camera)", gather_gaussians_spv, gather_gaussians_paged_spv,
                  true);
            if (all.has_secondary_rays)
                order(programs.gather, "gather_gaussians", gather_gaussians_spv, gather_gaussians_paged_spv);
            return;
        }
        order(programs.composite_camera, "composite_gaussians (camera)", composite_gaussians_spv,
              composite_gaussians_paged_spv, true);
        order(programs.gaussian_first_hits, "gaussian_first_hits", gaussian_first_hits_spv,
              gaussian_first_hits_paged_spv, true);
        if (all.has_secondary_rays)
            order(programs.composite, "composite_gaussians", composite_gaussians_spv, composite_gaussians_paged_spv);
    };
    if (instance.is_gaussian) {
        orderComposite();
        if (storesShadowRays(all))
            order(programs.attenuate_shadow_ray, "attenuate_shadow_ray", attenuate_shadow_ray_spv,
                  attenuate_shadow_ray_paged_spv);
        if (all.has_direct_lighting && (all.relights || !storesShadowRays(all)))
            order(programs.attenuate_shadow, "attenuate_shadow", attenuate_shadow_spv, attenuate_shadow_paged_spv);
        return;
    }
    if (instance.pooled_tiles > 0) return orderPooled(constants, all, programs, orders);
    const auto orderTrace = [&](Program& program, const char* name, std::span<const std::uint32_t> walk,
                                std::span<const std::uint32_t> hardware, std::span<const std::uint32_t> with_pages) {
        order(program, name, instance.queries_rays ? hardware : walk, with_pages);
    };
    orderTrace(programs.intersect_camera, "intersect_camera", intersect_camera_spv, intersect_camera_hardware_spv,
               intersect_camera_paged_spv);
    order(programs.camera_surface, "surface (camera)", surface_spv, surface_paged_spv, true);
    if (storesShadowRays(all))
        orderTrace(programs.intersect_shadow_ray, "intersect_shadow_ray", intersect_shadow_ray_spv,
                   intersect_shadow_ray_hardware_spv, intersect_shadow_ray_paged_spv);
    if (queuesShadowRays(all))
        orderTrace(programs.intersect_shadow, "intersect_shadow", intersect_shadow_spv, intersect_shadow_hardware_spv,
                   intersect_shadow_paged_spv);
    if (!all.has_secondary_rays) return;
    orderTrace(programs.intersect_closest, "intersect_closest", intersect_closest_spv, intersect_closest_hardware_spv,
               intersect_closest_paged_spv);
    order(programs.surface, "surface", surface_spv, surface_paged_spv);
}

Order intersectShadowShapes(const Constants& constants, Programs& programs) {
    return {&programs.intersect_shadow_shapes, "intersect_shadow_shapes", intersect_shadow_shapes_spv, constants};
}

/// Appends orders for the programs with which Gaussians catch shadows.
void orderShadowCatcher(const Constants& constants, const Constants& of_camera, Programs& programs,
                        std::vector<Order>& orders) {
    orders.push_back(
        {&programs.camera.query_shadow_catcher, "query_shadow_catcher (camera)", query_shadow_catcher_spv, of_camera});
    if (programs.has_secondary_rays)
        orders.push_back(
            {&programs.queued.query_shadow_catcher, "query_shadow_catcher", query_shadow_catcher_spv, constants});
    orders.push_back(intersectShadowShapes(constants, programs));
    orders.push_back({&programs.shade_shadow_catcher, "shade_shadow_catcher", shade_shadow_catcher_spv, constants});
}

/// Appends orders for the programs that composite Gaussians of several instances.
void orderBlending(const Constants& constants, const Constants& of_camera, Programs& programs,
                   std::vector<Order>& orders) {
    orders.push_back({&programs.blend_first_hits, "blend_first_hits", blend_first_hits_spv, of_camera});
    orders.push_back({&programs.camera.blend_gaussians, "blend_gaussians (camera)", blend_gaussians_spv, of_camera});
    if (programs.has_secondary_rays)
        orders.push_back({&programs.queued.blend_gaussians, "blend_gaussians", blend_gaussians_spv, constants});
}

/// Appends orders for the programs that process the queries of LIST_DIRECT_LIGHT.
void orderDirectLight(const Constants& constants, Programs& programs, std::vector<Order>& orders) {
    orders.push_back({&programs.shade_shadow, "shade_shadow", shade_shadow_spv, constants});
    if (programs.form == KernelForm::kMegakernel && programs.inline_nee) return;
    if (!programs.catches_shadows) orders.push_back(intersectShadowShapes(constants, programs));
    if (constants.gathers_photons) orders.push_back({&programs.caustic, "caustic", caustic_spv, constants});
}

void orderMegakernel(const Constants& constants, const Constants& of_camera, Programs& programs,
                     std::vector<Order>& orders) {
    orders.push_back({&programs.camera.megakernel, "megakernel (camera)", megakernel_spv, of_camera});
    if (programs.has_secondary_rays)
        orders.push_back({&programs.queued.megakernel, "megakernel", megakernel_spv, constants});
    if (!programs.samples_one_light) orderDirectLight(constants, programs, orders);
}

void orderWavefront(const Constants& constants, const Constants& of_camera, Programs& programs,
                    std::vector<Order>& orders) {
    orders.push_back({&programs.camera.shade_surface, "shade_surface (camera)", shade_surface_spv, of_camera});
    if (programs.has_secondary_rays)
        orders.push_back({&programs.queued.shade_surface, "shade_surface", shade_surface_spv, constants});
    if (programs.has_direct_lighting) orderDirectLight(constants, programs, orders);
}

void orderCull(std::uint32_t boxes, Constants constants, const Programs& all, CullPrograms& programs,
               std::vector<Order>& orders) {
    constants.cull_boxes = boxes;
    if (all.has_secondary_rays) orders.push_back({&programs.closest, "cull_closest", cull_closest_spv, constants});
    if (storesShadowRays(all))
        orders.push_back({&programs.shadow_ray, "cull_shadow_ray", cull_shadow_ray_spv, constants});
    if (queuesShadowRays(all)) orders.push_back({&programs.shadow, "cull_shadow", cull_shadow_spv, constants});
}

/// Appends orders for the culling programs, by the numbers of instances that the scene has or may have.
void orderCulling(const DeviceScene& scene, const Constants& constants, Programs& programs,
                  std::vector<Order>& orders) {
    const bool accumulates = mayCull(scene) || hasGaussians(scene);
    if (accumulates && !programs.accumulate_shadow.pipeline && storesShadowRays(programs))
        orders.push_back({&programs.accumulate_shadow, "accumulate_shadow", accumulate_shadow_spv, constants});
    if (!mayCull(scene)) return;
    if (!programs.compact.pipeline) orders.push_back({&programs.compact, "compact", compact_spv, constants});
    for (const std::uint32_t boxes : cullProgramSizes(scene)) {
        const auto [cull, is_new] = programs.cull.try_emplace(boxes);
        if (is_new) orderCull(boxes, constants, programs, cull->second, orders);
    }
}

/// Appends orders for the programs of instances whose traits no earlier instance has.
void orderInstances(const DeviceScene& scene, const Constants& constants, Programs& programs,
                    std::vector<Order>& orders) {
    const auto add = [&](const InstanceTraits& traits) {
        const auto [variant, is_new] = programs.variants.try_emplace(traits);
        if (is_new) orderFor(variant->first, constants, programs, variant->second, orders);
    };
    const auto addWithLater = [&](InstanceTraits traits, bool is_tile) {
        add(traits);
        if (!is_tile || scene.tile_cache_bytes == 0) return;
        // tiles loaded later may be uneven or not, and may have no balls
        for (const bool has_balls : {traits.has_balls, false}) {
            traits.has_balls = has_balls;
            for (const bool uneven : {false, true}) {
                traits.uneven = uneven;
                add(traits);
            }
        }
    };
    const std::vector<PooledGroup> pooled = makePooledGroups(scene);
    for (const std::size_t place : placesApart(scene, pooled))
        addWithLater(traitsOf(scene, scene.instances[place]), scene.instances[place].tile.has_value());
    for (const PooledGroup& group : pooled) addWithLater(group.traits, true);
}

/// All programs that the scene needs.
std::vector<Order> orderAll(const DeviceScene& scene, const Constants& constants, Programs& programs) {
    Constants of_camera = constants;
    of_camera.camera_pass = 1;
    std::vector<Order> orders{
        {&programs.prepare, "prepare", prepare_spv, constants},
        {&programs.first_hits, "first_hits", first_hits_spv, of_camera},
        {&programs.camera.intersect_shapes, "intersect_shapes (camera)", intersect_shapes_camera_spv, of_camera},
        {&programs.beam, "beam", beam_spv, constants},
        {&programs.fold_film, "fold_film", fold_film_spv, of_camera}};
    if (programs.form == KernelForm::kMegakernel)
        orderMegakernel(constants, of_camera, programs, orders);
    else
        orderWavefront(constants, of_camera, programs, orders);
    if (programs.has_secondary_rays && (programs.form == KernelForm::kWavefront || constants.gathers_photons))
        orders.push_back({&programs.queued.intersect_shapes, "intersect_shapes", intersect_shapes_spv, constants});
    if (constants.gathers_photons) orders.push_back({&programs.photon, "photon", photon_spv, constants});
    if (programs.merges_gaussians) orderBlending(constants, of_camera, programs, orders);
    if (programs.catches_shadows) orderShadowCatcher(constants, of_camera, programs, orders);
    orderInstances(scene, constants, programs, orders);
    orderCulling(scene, constants, programs, orders);
    return orders;
}

/// Drivers build a program on the calling thread. The slowest to build come first, so that all cores finish at about
/// the same time.
void buildAll(Device& device, std::vector<Order> orders) {
    std::sort(orders.begin(), orders.end(),
              [](const Order& a, const Order& b) { return a.spirv.size() > b.spirv.size(); });
    forAll(orders.size(), [&](std::size_t i) { build(device, orders[i]); });
}

/// Appends the bindings, besides instance and scene, that all programs of an instance share.
void addFrame(std::vector<BufferBinding>& bindings, const FrameBuffers& buffers, const CausticMap& caustics,
              const Buffer& cull_boxes) {
    for (const BufferBinding& each : frameBindings(buffers)) bindings.push_back(each);
    bindings.push_back({BINDING_CULL_BOXES, &cull_boxes});
    for (const BufferBinding& each : causticBindings(caustics)) bindings.push_back(each);
}

} // namespace

Programs createPrograms(Device& device, const DeviceScene& scene, const RenderSettings& settings, FormRequest form) {
    Programs programs;
    programs.form = kernelFormFor(settings.integrator, form);
    programs.has_secondary_rays = (scene.features & FEATURE_SECONDARY_RAYS) != 0;
    programs.has_direct_lighting = castsShadowRays(settings.integrator);
    programs.samples_one_light = samplesOneLight(settings.integrator);
    programs.one_bounce = tracesOneBounce(device);
    programs.defers_rays = mayDefer(scene, settings.integrator);
    programs.inline_nee = (scene.features & FEATURE_INLINE_NEE) != 0;
    programs.relights = (scene.features & FEATURE_RELIGHT) != 0;
    programs.cuts_loops = isCpu(device);
    programs.merges_gaussians = mergesGaussians(scene);
    programs.catches_shadows = hasGaussians(scene) && usesLights(settings.integrator);
    const OnError undo([&] { destroyPrograms(device, programs); });
    buildAll(device, orderAll(scene, constantsFor(device, scene, settings), programs));
    return programs;
}

void addPrograms(Device& device, const DeviceScene& scene, const RenderSettings& settings, Programs& programs) {
    std::vector<Order> orders;
    orderInstances(scene, constantsFor(device, scene, settings), programs, orders);
    orderCulling(scene, constantsFor(device, scene, settings), programs, orders);
    buildAll(device, std::move(orders));
}

void destroyPrograms(Device& device, Programs& programs) {
    for (Program* program : {&programs.prepare,
                             &programs.first_hits,
                             &programs.beam,
                             &programs.intersect_shadow_shapes,
                             &programs.shade_shadow,
                             &programs.photon,
                             &programs.caustic,
                             &programs.fold_film,
                             &programs.camera.intersect_shapes,
                             &programs.camera.query_shadow_catcher,
                             &programs.queued.query_shadow_catcher,
                             &programs.shade_shadow_catcher,
                             &programs.blend_first_hits,
                             &programs.camera.blend_gaussians,
                             &programs.queued.blend_gaussians,
                             &programs.camera.shade_surface,
                             &programs.camera.megakernel,
                             &programs.queued.intersect_shapes,
                             &programs.queued.shade_surface,
                             &programs.queued.megakernel,
                             &programs.compact,
                             &programs.accumulate_shadow})
        destroyProgram(device, *program);
    for (auto& [traits, variant] : programs.variants)
        for (Program* program :
             {&variant.beam, &variant.intersect_closest, &variant.intersect_camera, &variant.camera_surface,
              &variant.surface, &variant.intersect_shadow, &variant.intersect_shadow_ray, &variant.composite_camera,
              &variant.composite, &variant.gaussian_first_hits, &variant.gather_camera, &variant.gather,
              &variant.attenuate_shadow, &variant.attenuate_shadow_ray})
            destroyProgram(device, *program);
    programs.variants.clear();
    for (auto& [boxes, cull] : programs.cull)
        for (Program* program : {&cull.closest, &cull.shadow, &cull.shadow_ray}) destroyProgram(device, *program);
    programs.cull.clear();
}

const InstancePrograms& programsFor(const Programs& programs, const DeviceScene& scene, const Instance& instance) {
    return programs.variants.at(traitsOf(scene, instance));
}

DescriptorSets bindInstance(Device& device, VkDescriptorPool pool, const Programs& programs, const DeviceScene& scene,
                            const Instance& instance, const FrameBuffers& buffers, const CausticMap& caustics,
                            const Buffer& cull_boxes) {
    std::vector<BufferBinding> bindings = instanceBindings(scene, instance);
    addFrame(bindings, buffers, caustics, cull_boxes);
    const DeviceScan& file = scene.files[instance.file];
    const VkDescriptorSet common = createDescriptorSet(device, pool, programs.prepare, bindings);
    if (!isPaged(file.pages) && !file.queries_rays) return common;
    const InstancePrograms& own = programsFor(programs, scene, instance);
    if (file.queries_rays)
        return {common, createDescriptorSet(device, pool, own.intersect_camera, treeBindings(file.tree), SET_PAGES)};
    const Program& composite = programs.merges_gaussians ? own.gather_camera : own.composite_camera;
    const Program& tracing = file.is_gaussian ? composite : own.intersect_camera;
    return {common,
            createDescriptorSet(device, pool, tracing, pageBindings(instancePages(scene, instance)), SET_PAGES)};
}

DescriptorSets bindPooled(Device& device, VkDescriptorPool pool, const Programs& programs, const DeviceScene& scene,
                          const PooledGroup& group, const PooledBuffers& buffers) {
    std::vector<BufferBinding> bindings = blockBindings(*group.block);
    for (const BufferBinding& each : sceneBindings(scene, scene.instances[group.places[0]])) bindings.push_back(each);
    addFrame(bindings, buffers.frame, buffers.caustics, buffers.boxes);
    const BufferBinding tiles{BINDING_POOLED_TILES, &buffers.tiles};
    return {createDescriptorSet(device, pool, programs.prepare, bindings),
            createDescriptorSet(device, pool, programs.variants.at(group.traits).intersect_camera, std::span(&tiles, 1),
                                SET_PAGES)};
}

} // namespace pointrt
