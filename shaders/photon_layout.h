// SPDX-License-Identifier: Apache-2.0
// Photons that mirrors and glass have bundled, where they met a surface that scatters light. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_PHOTON_LAYOUT_H
#define POINTRT_SHADERS_PHOTON_LAYOUT_H

#ifdef __cplusplus
#include "shaders/vectors.h"
namespace pointrt::gpu {
#endif

// Two texels of the map; in the buffer that photons are traced into, one for each path.
struct Photon {
    vec4 position; // stage units; w: as bits, the surface's unit normal, octahedral in two signed halves
    vec4 flux;     // w: in the buffer, 1 where the path has left a photon; in the map, its level
};
#define PHOTON_VECTORS 2

// The map: photons sorted by bucket, and where each bucket starts (PHOTON_BUCKETS + 1 words). A photon's light is spread
// over a disc, small where photons are dense: its radius is that of its level, PHOTON_LEVEL_RATIO times that of the level
// below. Each level has a grid of its own, whose cells are as wide as its discs, so that those around a point lie in no
// more than 8. Enough buckets that hardly any two cells with photons share one.
#define PHOTON_BUCKETS 1048576u
#define PHOTON_LEVELS 4
#define PHOTON_LEVEL_RATIO 2.5f

// Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects (2003); the last is for levels.
#define PHOTON_HASH_X 73856093u
#define PHOTON_HASH_Y 19349663u
#define PHOTON_HASH_Z 83492791u
#define PHOTON_HASH_LEVEL 2654435761u

struct CausticFrame {
    vec4 kernel; // of level 0: x: radius, y: cells in a stage unit, z: inverse of the kernel's integral, 3 / (pi radius^2)
    uvec4 count; // x: photons
};

#ifdef __cplusplus
} // namespace pointrt::gpu
#endif

#endif
