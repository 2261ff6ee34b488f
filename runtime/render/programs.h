// SPDX-License-Identifier: Apache-2.0
// The renderer's compute programs. Programs that read an instance are specialized for its traits.
#pragma once

#include <map>
#include <span>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/program.h"
#include "runtime/render/instance_traits.h"
#include "runtime/render/kernel_form_choice.h"

namespace pointrt {

struct CausticMap;
struct FrameBuffers;
struct PooledGroup;

struct InstancePrograms {
    Program beam; ///< for pooled tiles; single instances share Programs::beam
    Program intersect_camera, camera_surface;
    Program intersect_closest, surface; ///< for secondary rays
    Program intersect_shadow,
        intersect_shadow_ray; ///< for queued shadow rays, the megakernel's stored ones, or both
    /// For Gaussians, which use these in place of the programs above.
    Program composite_camera, composite, gaussian_first_hits;
    Program gather_camera, gather; ///< the same if there are several instances of Gaussians
    /// For Gaussians, in place of intersect_shadow or intersect_shadow_ray.
    Program attenuate_shadow, attenuate_shadow_ray;
};

/// Programs with one variant for camera rays and one for queued rays (shaders/lib/features.glsl).
struct PassPrograms {
    Program intersect_shapes, shade_surface;
    Program megakernel;           ///< replaces shade_surface
    Program query_shadow_catcher; ///< if Gaussians catch shadows
    Program blend_gaussians;      ///< if there are several instances of Gaussians
};

/// Culling programs (shaders/trace/cull.glsl), named after the programs whose input lists they cull.
struct CullPrograms {
    Program closest, shadow, shadow_ray;
};

/// All declare the same bindings in set 0 (shaders/lib/bindings.glsl), those for paged instances also in set 1.
struct Programs {
    KernelForm form = KernelForm::kWavefront;
    /// If one is false, the programs that only it needs are not built.
    bool has_secondary_rays = true, has_direct_lighting = true;
    bool samples_one_light = false; ///< at each hit, instead of every light
    bool one_bounce = false;        ///< a megakernel traces one bounce per dispatch
    bool defers_rays = false;       ///< surfaces that reflect and refract defer rays
    bool inline_nee = false;        ///< see FEATURE_INLINE_NEE
    bool relights = false;          ///< Gaussians are lit: the programs that catch shadows shade them
    bool catches_shadows = false;   ///< Gaussians receive shadows of the objects among them
    bool cuts_loops = true;         ///< the device ends loops after 65,535 iterations, as lavapipe does
    bool merges_gaussians = false;  ///< Gaussians of several instances are composited together
    Program prepare, first_hits, beam, intersect_shadow_shapes, shade_shadow, photon, caustic, fold_film;
    Program shade_shadow_catcher, blend_first_hits;
    PassPrograms camera, queued;
    std::map<InstanceTraits, InstancePrograms> variants;
    std::map<std::uint32_t, CullPrograms> cull; ///< by the number of boxes (cullProgramSize)
    Program compact;                            ///< after culling
    Program accumulate_shadow;                  ///< after culling, or where Gaussians attenuate shadow rays
};

/// Builds the programs that the scene needs for the settings' integrator, in the requested form if possible.
Programs createPrograms(Device& device, const DeviceScene& scene, const RenderSettings& settings, FormRequest form);
/// Call after the scene's instances have changed: builds the additional programs that they need.
void addPrograms(Device& device, const DeviceScene& scene, const RenderSettings& settings, Programs& programs);
void destroyPrograms(Device& device, Programs& programs);

const InstancePrograms& programsFor(const Programs& programs, const DeviceScene& scene, const Instance& instance);

/// Descriptor sets with the buffers of an instance (and its pages if it has any), the frame, the caustics and the cull
/// boxes, for all programs including the instance's own. They take two sets of the pool.
DescriptorSets bindInstance(Device& device, VkDescriptorPool pool, const Programs& programs, const DeviceScene& scene,
                            const Instance& instance, const FrameBuffers& buffers, const CausticMap& caustics,
                            const Buffer& cull_boxes);

/// The bindings of programs for pooled tiles besides those of the scene.
struct PooledBuffers {
    const FrameBuffers& frame;
    const CausticMap& caustics;
    const Buffer& boxes; ///< gpu::CullBoxes
    const Buffer& tiles; ///< gpu::PooledTile rows
};
/// The same for the tiles in a block.
DescriptorSets bindPooled(Device& device, VkDescriptorPool pool, const Programs& programs, const DeviceScene& scene,
                          const PooledGroup& group, const PooledBuffers& buffers);

} // namespace pointrt
