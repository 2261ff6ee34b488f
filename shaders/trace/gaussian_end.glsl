// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_GAUSSIAN_END_GLSL
#define POINTRT_SHADERS_GAUSSIAN_END_GLSL

// A t beyond all others: of walks that are over, and of what a ray has not met.
const float kWalkEnded = 3e38;

#endif
