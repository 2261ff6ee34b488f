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
    Program beam; ///< of pooled tiles; single instances share Programs::beam
    Program intersect_camera, camera_surface;
    Program intersect_closest, surface; ///< for secondary rays
    Program intersect_shadow,
        intersect_shadow_ray; ///< queued shadow rays, the megakernel's stored ones, or both
    Program composite_camera, composite, gaussian_first_hits; ///< of Gaussians, which have these in place of the above
    Program gather_camera, gather;                  ///< or these, where there are several instances of Gaussians
    Program attenuate_shadow, attenuate_shadow_ray; ///< one of them, as above
};

/// Programs with one variant for camera rays and one for queued rays (shaders/lib/features.glsl).
struct PassPrograms {
    Program intersect_shapes, shade_surface;
    Program megakernel;           ///< in place of shade_surface
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
    bool has_secondary_rays = true, has_direct_lighting = true; ///< if false, the programs for it are not built
    bool samples_one_light = false;                             ///< at each hit, instead of every light
    bool one_bounce = false;                                    ///< of a megakernel in each dispatch
    bool defers_rays = false;                                   ///< of surfaces that reflect and refract
    bool inline_nee = false;                                    ///< see FEATURE_INLINE_NEE
    bool relights = false;                                      ///< Gaussians are lit: what catches shadows shades them
    bool catches_shadows = false;                               ///< Gaussians do, of the objects among them
    bool cuts_loops = true;        ///< the device does, as lavapipe, after 65,535 iterations
    bool merges_gaussians = false; ///< of several instances
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
/// Builds the programs that the scene's instances need in addition after they have changed.
void addPrograms(Device& device, const DeviceScene& scene, const RenderSettings& settings, Programs& programs);
void destroyPrograms(Device& device, Programs& programs);

const InstancePrograms& programsFor(const Programs& programs, const DeviceScene& scene, const Instance& instance);

/// Descriptor sets of an instance, its pages if it has any, the frame's buffers, the caustics and cull boxes, for all
/// programs and those of the instance. They take two sets of the pool.
DescriptorSets bindInstance(Device& device, VkDescriptorPool pool, const Programs& programs, const DeviceScene& scene,
                            const Instance& instance, const FrameBuffers& buffers, const CausticMap& caustics,
                            const Buffer& cull_boxes);

/// What the programs of pooled tiles bind beside the scene.
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
