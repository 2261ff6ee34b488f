// SPDX-License-Identifier: Apache-2.0
// The render cache on the device (runtime/window/live/device_reprojector.h). Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_REPROJECTION_LAYOUT_H
#define POINTRT_SHADERS_REPROJECTION_LAYOUT_H

#ifdef __cplusplus
#include "shaders/shared/vectors.h"
namespace pointrt::gpu {
#endif

// Lanes of a workgroup: a tile of pixels.
#define REPROJECT_GROUP 64

// CachedPoint::info holds these flags, then the number of samples averaged into the colour, and in the low bits the
// frame in which the point was traced.
#define POINT_IS_SKY (1u << 31)         // position is a direction
#define POINT_VIEW_DEPENDENT (1u << 30) // mirror or glossy: its colour changes with the view
#define POINT_INTERPOLATED (1u << 29)   // filled in between neighbours, never traced
#define POINT_ON_SHAPE (1u << 28)       // on a shape
#define POINT_INVALID (1u << 27)        // removed, must not be reprojected
#define POINT_SAMPLES_SHIFT 16
#define POINT_MAX_SAMPLES 7u
#define POINT_FRAME_MASK 0xFFFFu

// Each frame considers one row of pixels in ROW_PHASES, which takes a quarter of the time; and the number of considered
// pixels in a tile.
#define ROW_PHASES 4u
#define CONSIDERED_OF_TILE 16u
// Rounds that balance the number of selected pixels: each finds more pixels that are certain to be selected.
#define BALANCE_ROUNDS 3u

struct ReprojectionParams {
    vec3 eye;
    float tan_half_fov;
    vec3 right;
    float aspect;
    vec3 up;
    float half_window;
    vec3 forward;
    uint frame; // number
    uint width; // of the picture
    uint height;
    uint tiles_across;
    uint tiles_down;
    float focus_x; // attention point, pixels
    float focus_y;
    uint selected;     // pixels to select, on average
    uint listed;       // pixels traced: the most that can be selected
    uint points;       // places in the cache
    uint most_gaps;    // number of gaps beyond which points are resampled
    uint camera_moves; // 0 or 1, as is_noisy
    uint is_noisy;     // Monte Carlo light: one sample is unreliable
    float gain;        // of the light shown
    uint display;      // DISPLAY_*
    uint film_stride;  // pixels of a layer of the film
    uint unused_0;
};

struct ReprojectionControl {
    uint point_count; // places used so far; may temporarily exceed the number of places, until the next frame
    uint cursor;      // where the search for a replaceable point continues
    uint empty;       // pixels that no point was projected to
    uint unused_0;
    // number of pixels, for the frame
    uint selected;
    uint gaps;         // empty pixels within a surface
    float probability; // that selects a pixel of priority 1
    uint is_balanced;  // more rounds would not change the probability
};

// Sums over the considered pixels in a row of tiles.
struct RowSum {
    float priority;
    float certain; // pixels that are selected in any case
};

struct TileColors {
    uint red;
    uint green;
    uint blue;
    uint count;
    uint surfaces; // points that are not of the sky
};

#define REPROJECT_IF_GAPS 1u      // only if there are too many gaps
#define REPROJECT_SHAPES 2u       // shapes have changed
#define REPROJECT_KEEPS_POINTS 4u // reset only the tiles
#define REPROJECT_CLEARS 8u       // removes all points

struct ReprojectionPush {
    uint first; // pixel, or hit
    uint count; // number of lanes that have work
    uint bits;  // REPROJECT_*
    float share;
};

#ifdef __cplusplus
POINTRT_ROWS(ReprojectionParams, 8);
POINTRT_ROWS(ReprojectionControl, 2);
POINTRT_ROWS(ReprojectionPush, 1);
} // namespace pointrt::gpu
#endif

#endif
