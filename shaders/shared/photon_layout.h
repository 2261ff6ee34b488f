// SPDX-License-Identifier: Apache-2.0
// Photons that mirrors and glass have bundled, where they met a surface that scatters light. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_PHOTON_LAYOUT_H
#define POINTRT_SHADERS_PHOTON_LAYOUT_H

#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

// Two texels of the map; in the buffer that photons are traced into, one for each path.
struct Photon {
    vec4 position; // render units; w: as bits, the surface's unit normal in three signed bytes
    vec4 flux;     // w: in the buffer, 1 where the path has left a photon; in the map, its level
};
#define PHOTON_VECTORS 2

// The map: photons, and buckets that list them. A photon's light is spread over a disc, small where photons are dense:
// its radius is that of its level, PHOTON_LEVEL_RATIO times that of the level below. Each level has a grid of its own,
// whose cells are as wide as its discs, and each of the cells that a disc meets, 8 at most, lists its photon: all
// around a point are then listed by the cell that it is in. Cells share buckets by a hash; there are enough of them
// that hardly any two cells with photons do. The buckets' words: where each bucket's list starts among them and the
// last one ends (PHOTON_BUCKETS + 1), then the lists, numbers of photons, none twice in a bucket.
#define PHOTON_BUCKETS 1048576u
#define PHOTON_LEVELS 6
#define PHOTON_LEVEL_RATIO 1.7f
// A disc lights what is within its radius, and no farther from its plane than this share of it.
#define PHOTON_REACH 0.5f

// Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects (2003); the last is for
// levels.
#define PHOTON_HASH_X 73856093u
#define PHOTON_HASH_Y 19349663u
#define PHOTON_HASH_Z 83492791u
#define PHOTON_HASH_LEVEL 2654435761u

struct PhotonLevel {
    vec4 low;  // corners of the box around its discs, low above high where it has none; w: cells in a render unit
    vec4 high; // w: radius
};

struct CausticFrame {
    PhotonLevel levels[PHOTON_LEVELS];
    uvec4 count; // x: photons
};

#ifdef __cplusplus
POINTRT_ROWS(Photon, PHOTON_VECTORS);
POINTRT_ROWS(CausticFrame, 2 * PHOTON_LEVELS + 1);
} // namespace pointrt::gpu
#endif

#endif
