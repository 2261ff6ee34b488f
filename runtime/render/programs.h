// SPDX-License-Identifier: Apache-2.0
// The tracer's compute programs. Those that look into an instance are built for what it is like.
#pragma once

#include <map>
#include <span>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/program.h"
#include "runtime/render/instance_traits.h"
#include "runtime/render/pass_form.h"

namespace pointrt {

struct CausticMap;
struct FrameBuffers;

struct InstancePrograms {
    Program trace_primary, camera_surface;
    Program trace, surface;       ///< of rays that go on
    Program shadow, shadow_light; ///< of light, of either form
};

/// What camera rays and queued rays have one each of (shaders/lib/features.glsl).
struct PassPrograms {
    Program trace_shapes, shade;
    Program follow; ///< of the fused form, in place of shade
};

/// What sifts rays for targets (shaders/trace/sift.glsl), each a list.
struct SievePrograms {
    Program asked, turns, shadow_rays;
};

/// All declare the same bindings in set 0 (shaders/lib/bindings.glsl), and those for paged instances in set 1.
struct Programs {
    PassForm form = PassForm::kQueued;
    bool rays_go_on = true, show_light = true; ///< else the programs for that are not built
    bool asks_one = false;                     ///< light of all at each hit
    bool light_on_the_way = false;             ///< see FEATURE_LIGHT_ON_THE_WAY
    Program prepare, first_hits, beam, shadow_shapes, light, photon, caustic;
    PassPrograms camera, queued;
    std::map<InstanceTraits, InstancePrograms> variants;
    std::map<std::uint32_t, SievePrograms> sieves; ///< by how many boxes there may be
    Program place, bring;                          ///< of what was sifted
};

/// Builds what the scene needs for the settings' integrator, in the form asked for where that can be.
Programs createPrograms(Device& device, const DeviceScene& scene, const RenderSettings& settings, FormRequest form);
/// Builds what the scene's instances need besides, now that they are others.
void addPrograms(Device& device, const DeviceScene& scene, const RenderSettings& settings, Programs& programs);
void destroyPrograms(Device& device, Programs& programs);

const InstancePrograms& programsFor(const Programs& programs, const DeviceScene& scene, const Instance& instance);

/// Sets with the instance, its pages where it has any, the frame's buffers, the caustics and a sieve, for all programs
/// and those of the instance. They take two of the pool's sets.
DescriptorSets bindInstance(Device& device, VkDescriptorPool pool, const Programs& programs, const DeviceScene& scene,
                            const Instance& instance, const FrameBuffers& buffers, const CausticMap& caustics,
                            const Buffer& sieve);

} // namespace pointrt
