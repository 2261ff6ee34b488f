// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_GAUSSIAN_END_GLSL
#define POINTRT_SHADERS_GAUSSIAN_END_GLSL

// A t beyond all others: marks the end of a walk, and a missing hit.
const float kWalkEnded = 3e38;

#endif
