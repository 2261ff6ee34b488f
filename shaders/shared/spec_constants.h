// SPDX-License-Identifier: Apache-2.0
// Specialization constants by name, for GLSL's constant_id and for C++, which gives values by name. No number stands
// for two things; programs must be given all that they declare (runtime/gpu/program.h).
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

// The tracer's: what is known of an instance (shaders/trace/instance.glsl), and of the scene
// (shaders/lib/features.glsl).
#define SPEC_UNEVEN POINTRT_SPEC(0)
#define SPEC_ORIENTED POINTRT_SPEC(1)
#define SPEC_SKY_IMAGE POINTRT_SPEC(2)
#define SPEC_INTEGRATOR POINTRT_SPEC(3)
#define SPEC_FEATURES POINTRT_SPEC(4)
#define SPEC_CAMERA_PASS POINTRT_SPEC(5)
// Pages in use (shaders/lib/pages.glsl).
#define SPEC_PAGE_BITS POINTRT_SPEC(6)
#define SPEC_BRICK_PAGES POINTRT_SPEC(7)
#define SPEC_CELL_PAGES POINTRT_SPEC(8)
#define SPEC_SLAB_PAGES POINTRT_SPEC(9)
#define SPEC_NEAR_PAGES POINTRT_SPEC(10)
#define SPEC_LISTED_PAGES POINTRT_SPEC(11)
#define SPEC_BLENDING_PAGES POINTRT_SPEC(12)
#define SPEC_SPLAT_PAGES POINTRT_SPEC(13)
// Whether the instance has noise.
#define SPEC_NOISY POINTRT_SPEC(17)
// Whether points gather photons where they ask for light, in the fused form.
#define SPEC_GATHERS_PHOTONS POINTRT_SPEC(18)
// Kinds of the scene's shapes where it has few (scene_layout.h).
#define SPEC_SHAPE_KINDS POINTRT_SPEC(19)
// Whether the instance is a tile of a set.
#define SPEC_CORED POINTRT_SPEC(20)
// Boxes of a sieve (shaders/trace/sift.glsl), a multiple of 8 up to SIEVE_TARGETS.
#define SPEC_SIEVE_BOXES POINTRT_SPEC(21)
// Whether rays of batches are given in doubles (shaders/cast/given_rays.glsl).
#define SPEC_CAST_DOUBLES POINTRT_SPEC(22)
// The display pipeline's and the denoiser's.
#define SPEC_HAS_FIRST_HITS POINTRT_SPEC(14)
#define SPEC_KNOWS_VARIANCE POINTRT_SPEC(15)
#define SPEC_IS_LAST_LEVEL POINTRT_SPEC(16)

#endif
