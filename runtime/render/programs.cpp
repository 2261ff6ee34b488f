// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/programs.h"

#include <algorithm>
#include <span>
#include <vector>

#include "format/base/parallel.h"
#include "runtime/device_scene/scene_rows.h"
#include "runtime/render/caustic_map.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/render/sieves.h"
#include "runtime/util/on_error.h"
#include "shaders/beam.spv.h"
#include "shaders/bring.spv.h"
#include "shaders/caustic.spv.h"
#include "shaders/first_hits.spv.h"
#include "shaders/follow.spv.h"
#include "shaders/light.spv.h"
#include "shaders/photon.spv.h"
#include "shaders/place.spv.h"
#include "shaders/prepare.spv.h"
#include "shaders/shade.spv.h"
#include "shaders/shadow.spv.h"
#include "shaders/shadow_light.spv.h"
#include "shaders/shadow_light_paged.spv.h"
#include "shaders/shadow_paged.spv.h"
#include "shaders/shadow_shapes.spv.h"
#include "shaders/sift_asked.spv.h"
#include "shaders/sift_shadow_rays.spv.h"
#include "shaders/sift_turns.spv.h"
#include "shaders/surface.spv.h"
#include "shaders/surface_paged.spv.h"
#include "shaders/trace.spv.h"
#include "shaders/trace_paged.spv.h"
#include "shaders/trace_primary.spv.h"
#include "shaders/trace_primary_paged.spv.h"
#include "shaders/trace_shapes.spv.h"

namespace pointrt {

namespace {

/// Values of the programs' specialization constants.
struct Constants {
    InstanceTraits instance;
    std::uint32_t sky_image = 0, integrator = 0, features = 0, camera_pass = 0, gathers_photons = 0, shape_kinds = 0;
    std::uint32_t sieve_boxes = 0;
};

std::vector<SpecConstant> listed(const Constants& c) {
    std::vector<SpecConstant> values = traitConstants(c.instance);
    values.insert(values.end(), {{SPEC_SKY_IMAGE, c.sky_image},
                                 {SPEC_INTEGRATOR, c.integrator},
                                 {SPEC_FEATURES, c.features},
                                 {SPEC_CAMERA_PASS, c.camera_pass},
                                 {SPEC_GATHERS_PHOTONS, c.gathers_photons},
                                 {SPEC_SHAPE_KINDS, c.shape_kinds},
                                 {SPEC_SIEVE_BOXES, c.sieve_boxes}});
    return values;
}

/// A program to be built.
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

Constants constantsFor(const DeviceScene& scene, const RenderSettings& settings) {
    Constants constants;
    constants.sky_image = scene.sky_light != NO_LIGHT;
    constants.integrator = static_cast<std::uint32_t>(settings.integrator);
    constants.features = scene.features;
    constants.shape_kinds = shapeKinds(scene.shape_rows);
    constants.gathers_photons = castsCaustics(scene) && showsLight(settings.integrator);
    // beams have one program for all instances, and the cores of files are their grids
    constants.instance.cored = !scene.sets.empty();
    return constants;
}

/// Fused, integrators that ask one light keep their shadow rays.
bool keepsShadowRays(const Programs& all) { return all.form == PassForm::kFused && all.asks_one; }

void orderFor(const InstanceTraits& instance, Constants constants, const Programs& all, InstancePrograms& programs,
              std::vector<Order>& orders) {
    constants.instance = instance;
    const bool paged = isPaged(instance.pages);
    const auto order = [&](Program& program, const char* name, std::span<const std::uint32_t> plain,
                           std::span<const std::uint32_t> with_pages, bool of_camera = false) {
        constants.camera_pass = of_camera;
        orders.push_back({&program, name, paged ? with_pages : plain, constants});
    };
    order(programs.trace_primary, "trace_primary", trace_primary_spv, trace_primary_paged_spv);
    order(programs.camera_surface, "surface (camera)", surface_spv, surface_paged_spv, true);
    if (keepsShadowRays(all))
        order(programs.shadow_light, "shadow_light", shadow_light_spv, shadow_light_paged_spv);
    else if (all.show_light)
        order(programs.shadow, "shadow", shadow_spv, shadow_paged_spv);
    if (!all.rays_go_on) return;
    order(programs.trace, "trace", trace_spv, trace_paged_spv);
    order(programs.surface, "surface", surface_spv, surface_paged_spv);
}

/// What brings light to the points that ask for it.
void orderLight(const Constants& constants, Programs& programs, std::vector<Order>& orders) {
    orders.push_back({&programs.light, "light", light_spv, constants});
    if (programs.form == PassForm::kFused && programs.light_on_the_way) return;
    orders.push_back({&programs.shadow_shapes, "shadow_shapes", shadow_shapes_spv, constants});
    if (constants.gathers_photons) orders.push_back({&programs.caustic, "caustic", caustic_spv, constants});
}

/// What follows on a path's hits, in the fused form.
void orderFused(const Constants& constants, const Constants& of_camera, Programs& programs,
                std::vector<Order>& orders) {
    orders.push_back({&programs.camera.follow, "follow (camera)", follow_spv, of_camera});
    if (programs.rays_go_on) orders.push_back({&programs.queued.follow, "follow", follow_spv, constants});
    if (!programs.asks_one) orderLight(constants, programs, orders);
}

/// The same in the other one.
void orderQueued(const Constants& constants, const Constants& of_camera, Programs& programs,
                 std::vector<Order>& orders) {
    orders.push_back({&programs.camera.shade, "shade (camera)", shade_spv, of_camera});
    if (programs.rays_go_on) orders.push_back({&programs.queued.shade, "shade", shade_spv, constants});
    if (programs.show_light) orderLight(constants, programs, orders);
}

void orderSieve(std::uint32_t boxes, Constants constants, const Programs& all, SievePrograms& programs,
                std::vector<Order>& orders) {
    constants.sieve_boxes = boxes;
    if (all.rays_go_on) orders.push_back({&programs.asked, "sift_asked", sift_asked_spv, constants});
    if (keepsShadowRays(all))
        orders.push_back({&programs.shadow_rays, "sift_shadow_rays", sift_shadow_rays_spv, constants});
    else if (all.show_light)
        orders.push_back({&programs.turns, "sift_turns", sift_turns_spv, constants});
}

/// What sifts rays for as many instances as there are, or may be.
void orderSieves(const DeviceScene& scene, const Constants& constants, Programs& programs, std::vector<Order>& orders) {
    if (!maySift(scene)) return;
    if (!programs.place.pipeline) orders.push_back({&programs.place, "place", place_spv, constants});
    if (!programs.bring.pipeline && keepsShadowRays(programs))
        orders.push_back({&programs.bring, "bring", bring_spv, constants});
    for (const std::uint32_t boxes : sieveSizes(scene)) {
        const auto [sieve, is_new] = programs.sieves.try_emplace(boxes);
        if (is_new) orderSieve(boxes, constants, programs, sieve->second, orders);
    }
}

/// Those of instances that are like none before.
void orderInstances(const DeviceScene& scene, const Constants& constants, Programs& programs,
                    std::vector<Order>& orders) {
    const auto add = [&](const InstanceTraits& traits) {
        const auto [variant, is_new] = programs.variants.try_emplace(traits);
        if (is_new) orderFor(variant->first, constants, programs, variant->second, orders);
    };
    for (const Instance& instance : scene.instances) {
        InstanceTraits traits = traitsOf(scene, instance);
        add(traits);
        // tiles that come are even or not
        traits.uneven = !traits.uneven;
        if (instance.tile && scene.tile_cache_bytes > 0) add(traits);
    }
}

/// What is needed, for places in programs.
std::vector<Order> orderAll(const DeviceScene& scene, const Constants& constants, Programs& programs) {
    Constants of_camera = constants;
    of_camera.camera_pass = 1;
    std::vector<Order> orders{{&programs.prepare, "prepare", prepare_spv, constants},
                              {&programs.first_hits, "first_hits", first_hits_spv, of_camera},
                              {&programs.camera.trace_shapes, "trace_shapes (camera)", trace_shapes_spv, of_camera},
                              {&programs.beam, "beam", beam_spv, constants}};
    if (programs.form == PassForm::kFused)
        orderFused(constants, of_camera, programs, orders);
    else
        orderQueued(constants, of_camera, programs, orders);
    if (programs.rays_go_on && (programs.form == PassForm::kQueued || constants.gathers_photons))
        orders.push_back({&programs.queued.trace_shapes, "trace_shapes", trace_shapes_spv, constants});
    if (constants.gathers_photons) orders.push_back({&programs.photon, "photon", photon_spv, constants});
    orderInstances(scene, constants, programs, orders);
    orderSieves(scene, constants, programs, orders);
    return orders;
}

/// Drivers build them on the thread that asks: the longest first, so that all cores are done about together.
void buildAll(Device& device, std::vector<Order> orders) {
    std::sort(orders.begin(), orders.end(),
              [](const Order& a, const Order& b) { return a.spirv.size() > b.spirv.size(); });
    forAll(orders.size(), [&](std::size_t i) { build(device, orders[i]); });
}

} // namespace

Programs createPrograms(Device& device, const DeviceScene& scene, const RenderSettings& settings, FormRequest form) {
    Programs programs;
    programs.form = passFormFor(device.type, settings.integrator, form);
    programs.rays_go_on = (scene.features & FEATURE_GOES_ON) != 0;
    programs.show_light = showsLight(settings.integrator);
    programs.asks_one = asksOneLight(settings.integrator);
    programs.light_on_the_way = (scene.features & FEATURE_LIGHT_ON_THE_WAY) != 0;
    const OnError undo([&] { destroyPrograms(device, programs); });
    buildAll(device, orderAll(scene, constantsFor(scene, settings), programs));
    return programs;
}

void addPrograms(Device& device, const DeviceScene& scene, const RenderSettings& settings, Programs& programs) {
    std::vector<Order> orders;
    orderInstances(scene, constantsFor(scene, settings), programs, orders);
    orderSieves(scene, constantsFor(scene, settings), programs, orders);
    buildAll(device, std::move(orders));
}

void destroyPrograms(Device& device, Programs& programs) {
    for (Program* program : {&programs.prepare, &programs.first_hits, &programs.beam, &programs.shadow_shapes,
                             &programs.light, &programs.photon, &programs.caustic, &programs.camera.trace_shapes,
                             &programs.camera.shade, &programs.camera.follow, &programs.queued.trace_shapes,
                             &programs.queued.shade, &programs.queued.follow, &programs.place, &programs.bring})
        destroyProgram(device, *program);
    for (auto& [traits, variant] : programs.variants)
        for (Program* program : {&variant.trace, &variant.trace_primary, &variant.camera_surface, &variant.surface,
                                 &variant.shadow, &variant.shadow_light})
            destroyProgram(device, *program);
    programs.variants.clear();
    for (auto& [boxes, sieve] : programs.sieves)
        for (Program* program : {&sieve.asked, &sieve.turns, &sieve.shadow_rays}) destroyProgram(device, *program);
    programs.sieves.clear();
}

const InstancePrograms& programsFor(const Programs& programs, const DeviceScene& scene, const Instance& instance) {
    return programs.variants.at(traitsOf(scene, instance));
}

DescriptorSets bindInstance(Device& device, VkDescriptorPool pool, const Programs& programs, const DeviceScene& scene,
                            const Instance& instance, const FrameBuffers& buffers, const CausticMap& caustics,
                            const Buffer& sieve) {
    std::vector<BufferBinding> bindings = instanceBindings(scene, instance);
    for (const BufferBinding& each : frameBindings(buffers)) bindings.push_back(each);
    bindings.push_back({BINDING_SIEVE, &sieve});
    for (const BufferBinding& each : causticBindings(caustics)) bindings.push_back(each);
    const DeviceScan& file = scene.files[instance.file];
    const VkDescriptorSet common = createDescriptorSet(device, pool, programs.prepare, bindings);
    if (!isPaged(file.pages)) return common;
    const Program& tracing = programsFor(programs, scene, instance).trace_primary;
    return {common,
            createDescriptorSet(device, pool, tracing, pageBindings(instancePages(scene, instance)), SET_PAGES)};
}

} // namespace pointrt
