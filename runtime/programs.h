// SPDX-License-Identifier: Apache-2.0
// The tracer's compute programs. Those that walk through an instance are built for what it is like.
#pragma once

#include <array>
#include <optional>

#include "runtime/program.h"
#include "runtime/staged_scene.h"

namespace pointrt {

/// Programs that know whether an instance is uneven and oriented (shaders/instance.glsl).
struct InstancePrograms {
    Program trace, trace_primary, surface, shadow;
};

/// All declare the same bindings (shaders/bindings.glsl).
struct Programs {
    Program prepare, trace_shapes, beam, shade, shadow_shapes, light, photon, caustic;
    std::array<std::optional<InstancePrograms>, 4> variants;
};

/// Builds what the scene needs for the settings' integrator.
Programs createPrograms(Device& device, const StagedScene& scene, const RenderSettings& settings);
void destroyPrograms(Device& device, Programs& programs);

const InstancePrograms& programsFor(const Programs& programs, const StagedScene& scene, const Instance& instance);

} // namespace pointrt
