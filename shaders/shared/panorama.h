// SPDX-License-Identifier: Apache-2.0
// Panoramas in stereo, as host and shaders share them. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_PANORAMA_H
#define POINTRT_SHADERS_PANORAMA_H

// Cosine of 60 degrees: the eyes are the full distance apart up to this latitude, and approach each other beyond. At
// the poles, all longitudes look in the same direction; from different positions, they would make the picture swirl
// there.
#define PANORAMA_FULL_STEREO_COSINE 0.5f

#endif
