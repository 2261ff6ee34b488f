// SPDX-License-Identifier: Apache-2.0
// The buffers of a batch of rays.
#ifndef POINTRT_SHADERS_CAST_BINDINGS_GLSL
#define POINTRT_SHADERS_CAST_BINDINGS_GLSL
#include "shaders/shared/bindings.h"
#include "shaders/shared/cast_layout.h"
#include "shaders/shared/params.h"

// CastRay; with GIVEN, rays in the caller's layout
layout(rgba32ui, binding = BINDING_CAST_RAYS) uniform readonly uimageBuffer cast_ray_texels;
layout(r32ui, binding = BINDING_CAST_STOPPED) uniform writeonly uimageBuffer cast_stopped; // per ray: 0 unless occluded

#endif
