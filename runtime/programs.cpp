// SPDX-License-Identifier: Apache-2.0
#include "runtime/programs.h"

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

struct Kind {
    std::uint32_t uneven, oriented, picture; ///< the shaders' specialization constants 0, 1, 2
};

Kind kindOf(const StagedScene& scene, const Instance& instance) {
    return {scene.files[instance.file].grid_frame.uneven ? 1u : 0u, instance.oriented ? 1u : 0u,
            scene.sky_light != NO_LIGHT ? 1u : 0u};
}

std::size_t slotOf(Kind kind) { return kind.uneven + 2 * kind.oriented; }

InstancePrograms createVariant(Device& device, Kind kind) {
    return {createProgram(device, "trace", trace_spv, {kind.uneven, kind.oriented}),
            createProgram(device, "trace_primary", trace_primary_spv, {kind.uneven, kind.oriented}),
            createProgram(device, "surface", surface_spv, {kind.uneven, kind.oriented}),
            createProgram(device, "shadow", shadow_spv, {kind.uneven, kind.oriented, kind.picture})};
}

} // namespace

Programs createPrograms(Device& device, const StagedScene& scene) {
    Programs programs;
    programs.prepare = createProgram(device, "prepare", prepare_spv);
    programs.trace_shapes = createProgram(device, "trace_shapes", trace_shapes_spv);
    programs.beam = createProgram(device, "beam", beam_spv);
    const std::uint32_t picture = scene.sky_light != NO_LIGHT;
    programs.shade = createProgram(device, "shade", shade_spv, {0, 0, picture});
    programs.shadow_shapes = createProgram(device, "shadow_shapes", shadow_shapes_spv, {0, 0, picture});
    programs.light = createProgram(device, "light", light_spv, {0, 0, picture});
    if (castsCaustics(scene)) {
        programs.photon = createProgram(device, "photon", photon_spv, {0, 0, picture});
        programs.caustic = createProgram(device, "caustic", caustic_spv, {0, 0, picture});
    }
    for (const Instance& instance : scene.instances) {
        const Kind kind = kindOf(scene, instance);
        auto& variant = programs.variants[slotOf(kind)];
        if (!variant) variant = createVariant(device, kind);
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
    return *programs.variants[slotOf(kindOf(scene, instance))];
}

} // namespace pointrt
