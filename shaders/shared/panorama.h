// SPDX-License-Identifier: Apache-2.0
// Panoramas in stereo, as host and shaders share them. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_PANORAMA_H
#define POINTRT_SHADERS_PANORAMA_H

// Eyes are the full distance apart up to a latitude of 60 degrees, whose cosine this is. Beyond it they approach each
// other: at the poles, every longitude looks in the same direction but from another place, so the picture would swirl
// there.
#define PANORAMA_FULL_STEREO_COSINE 0.5f

#endif
