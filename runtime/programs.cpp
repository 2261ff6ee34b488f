// SPDX-License-Identifier: Apache-2.0
#include "runtime/programs.h"

#include <span>

#include "shaders/beam.spv.h"
#include "shaders/caustic.spv.h"
#include "shaders/light.spv.h"
#include "shaders/photon.spv.h"
#include "shaders/prepare.spv.h"
#include "shaders/shade.spv.h"
#include "shaders/shadow.spv.h"
#include "shaders/shadow_shapes.spv.h"
#include "shaders/surface.spv.h"
#include "shaders/trace.spv.h"
#include "shaders/trace_primary.spv.h"
#include "shaders/trace_shapes.spv.h"

namespace pointrt {

namespace {

/// Values of the shaders' specialization constants, by number.
struct Constants {
    std::uint32_t uneven = 0, oriented = 0, sky_picture = 0, integrator = 0, features = 0;
};

Program build(Device& device, const char* name, std::span<const std::uint32_t> spirv, const Constants& c) {
    return createProgram(device, name, spirv, {c.uneven, c.oriented, c.sky_picture, c.integrator, c.features});
}

Constants constantsFor(const StagedScene& scene, const RenderSettings& settings) {
    return {0, 0, scene.sky_light != NO_LIGHT, static_cast<std::uint32_t>(settings.integrator), scene.features};
}

Constants constantsFor(const StagedScene& scene, const Instance& instance, Constants constants) {
    constants.uneven = scene.files[instance.file].index.uneven;
    constants.oriented = instance.oriented;
    return constants;
}

std::size_t slotOf(const Constants& constants) { return constants.uneven + 2 * constants.oriented; }

void buildVariant(Device& device, const Constants& constants, InstancePrograms& programs) {
    programs.trace = build(device, "trace", trace_spv, constants);
    programs.trace_primary = build(device, "trace_primary", trace_primary_spv, constants);
    programs.surface = build(device, "surface", surface_spv, constants);
    programs.shadow = build(device, "shadow", shadow_spv, constants);
}

void buildAll(Device& device, const StagedScene& scene, const Constants& constants, Programs& programs) {
    programs.prepare = build(device, "prepare", prepare_spv, constants);
    programs.trace_shapes = build(device, "trace_shapes", trace_shapes_spv, constants);
    programs.beam = build(device, "beam", beam_spv, constants);
    programs.shade = build(device, "shade", shade_spv, constants);
    programs.shadow_shapes = build(device, "shadow_shapes", shadow_shapes_spv, constants);
    programs.light = build(device, "light", light_spv, constants);
    if (castsCaustics(scene)) {
        programs.photon = build(device, "photon", photon_spv, constants);
        programs.caustic = build(device, "caustic", caustic_spv, constants);
    }
    for (const Instance& instance : scene.instances) {
        const Constants of_instance = constantsFor(scene, instance, constants);
        auto& variant = programs.variants[slotOf(of_instance)];
        if (!variant) buildVariant(device, of_instance, variant.emplace());
    }
}

} // namespace

Programs createPrograms(Device& device, const StagedScene& scene, const RenderSettings& settings) {
    Programs programs;
    try {
        buildAll(device, scene, constantsFor(scene, settings), programs);
    } catch (...) {
        destroyPrograms(device, programs);
        throw;
    }
    return programs;
}

void destroyPrograms(Device& device, Programs& programs) {
    for (Program* program : {&programs.prepare, &programs.trace_shapes, &programs.beam, &programs.shade,
                             &programs.shadow_shapes, &programs.light, &programs.photon, &programs.caustic})
        destroyProgram(device, *program);
    for (auto& variant : programs.variants)
        if (variant)
            for (Program* program : {&variant->trace, &variant->trace_primary, &variant->surface, &variant->shadow})
                destroyProgram(device, *program);
    programs.variants = {};
}

const InstancePrograms& programsFor(const Programs& programs, const StagedScene& scene, const Instance& instance) {
    return *programs.variants[slotOf(constantsFor(scene, instance, {}))];
}

} // namespace pointrt
