// SPDX-License-Identifier: Apache-2.0
// The photon map of caustics: photons focused by mirrors and glass, stored where they hit a surface that scatters
// light. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_PHOTON_LAYOUT_H
#define POINTRT_SHADERS_PHOTON_LAYOUT_H

#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

// Two texels of the map. The buffer that photons are traced into has one Photon per path.
struct Photon {
    vec4 position; // render units; w: as bits, the surface's unit normal in three signed bytes
    vec4 flux;     // w: in the buffer, 1 if the path stored a photon; in the map, the photon's level
};
#define PHOTON_VECTORS 2

// The map consists of photons and of buckets that list them. A photon's flux is spread over a disc that is small where
// photons are dense: each level has a radius, PHOTON_LEVEL_RATIO times that of the level below, and a grid whose cells
// are as wide as its discs. Each cell that a disc overlaps (8 at most) lists the photon, so the cell that holds a point
// lists all photons whose discs reach it. A hash maps cells to buckets, of which there are enough that two cells with
// photons rarely share one. The words of the buckets: the start of each bucket's list and the end of the last
// (PHOTON_BUCKETS + 1 words), then the lists of photon indices, in which no index occurs twice.
#define PHOTON_BUCKETS 1048576u
#define PHOTON_LEVELS 6
#define PHOTON_LEVEL_RATIO 1.7f
// A disc lights points within its radius whose distance from its plane is at most this share of the radius.
#define PHOTON_REACH 0.5f

// Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects (2003); the last number
// hashes the level.
#define PHOTON_HASH_X 73856093u
#define PHOTON_HASH_Y 19349663u
#define PHOTON_HASH_Z 83492791u
#define PHOTON_HASH_LEVEL 2654435761u

struct PhotonLevel {
    vec4 low;  // corners of the box around the level's discs, low above high without discs; w: cells per render unit
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
