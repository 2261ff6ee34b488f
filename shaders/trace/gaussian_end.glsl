// SPDX-License-Identifier: Apache-2.0
#ifndef POINTRT_SHADERS_GAUSSIAN_END_GLSL
#define POINTRT_SHADERS_GAUSSIAN_END_GLSL

// A t beyond all others: marks a walk that is over, and a hit that a ray does not have.
const float kWalkEnded = 3e38;

#endif
