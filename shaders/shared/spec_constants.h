// SPDX-License-Identifier: Apache-2.0
// Specialization constants by name, for GLSL's constant_id and for C++. Numbers are unique; C++ must give a value for
// every constant that a program declares (runtime/gpu/program.h).
#ifndef POINTRT_SHADERS_SPEC_CONSTANTS_H
#define POINTRT_SHADERS_SPEC_CONSTANTS_H

#ifdef __cplusplus
#include <cstdint>
namespace pointrt::gpu {
enum class SpecId : std::uint32_t {};
}
#define POINTRT_SPEC(number) (::pointrt::gpu::SpecId{number})
#else
#define POINTRT_SPEC(number) number
#endif

// Traits of an instance (shaders/trace/instance.glsl) and features of the scene (shaders/lib/features.glsl).
#define SPEC_UNEVEN POINTRT_SPEC(0)
#define SPEC_ORIENTED POINTRT_SPEC(1)
#define SPEC_SKY_IMAGE POINTRT_SPEC(2)
#define SPEC_INTEGRATOR POINTRT_SPEC(3)
#define SPEC_FEATURES POINTRT_SPEC(4)
#define SPEC_CAMERA_PASS POINTRT_SPEC(5)
// Pages in use of each paged buffer (shaders/lib/pages.glsl).
#define SPEC_PAGE_BITS POINTRT_SPEC(6)
#define SPEC_BRICK_PAGES POINTRT_SPEC(7)
#define SPEC_CELL_PAGES POINTRT_SPEC(8)
#define SPEC_SLAB_PAGES POINTRT_SPEC(9)
#define SPEC_NEAR_PAGES POINTRT_SPEC(10)
#define SPEC_LISTED_PAGES POINTRT_SPEC(11)
#define SPEC_BLENDING_PAGES POINTRT_SPEC(12)
#define SPEC_SPLAT_PAGES POINTRT_SPEC(13)
// Whether the instance stores noise.
#define SPEC_NOISY POINTRT_SPEC(17)
// Whether the megakernel gathers photons along with next event estimation.
#define SPEC_GATHERS_PHOTONS POINTRT_SPEC(18)
// Kinds of the scene's shapes if they are few (scene_layout.h).
#define SPEC_SHAPE_KINDS POINTRT_SPEC(19)
// Whether hits are clipped to the core of a tile.
#define SPEC_CLIPS_TO_CORE POINTRT_SPEC(20)
// Boxes that a culling program tests (shaders/trace/cull.glsl), a multiple of 8 up to CULL_INSTANCES.
#define SPEC_CULL_BOXES POINTRT_SPEC(21)
// Whether the caller's rays are in doubles (shaders/cast/given_rays.glsl).
#define SPEC_CAST_DOUBLES POINTRT_SPEC(22)
// Whether splats of the instance may be balls.
#define SPEC_HAS_BALLS POINTRT_SPEC(23)
// Degree of the harmonics of an instance's Gaussians (shaders/shade/harmonics.glsl).
#define SPEC_HARMONICS POINTRT_SPEC(24)
// Whether the megakernel leaves its loop after one bounce.
#define SPEC_ONE_BOUNCE POINTRT_SPEC(25)
// Whether the scene has clips.
#define SPEC_CLIPPED POINTRT_SPEC(26)
// Eyes of a panorama (shaders/lib/camera_ray.glsl); 0: another camera.
#define SPEC_PANORAMA_EYES POINTRT_SPEC(28)
// Whether the instance's buffers are read as storage buffers (shaders/lib/instance_bindings.glsl).
#define SPEC_READS_STORAGE POINTRT_SPEC(27)
// Display pipeline and denoiser.
#define SPEC_HAS_FIRST_HITS POINTRT_SPEC(14)
#define SPEC_KNOWS_VARIANCE POINTRT_SPEC(15)
#define SPEC_IS_LAST_LEVEL POINTRT_SPEC(16)

#endif
