// SPDX-License-Identifier: Apache-2.0
// How much a splat counts where the surface is blended. Valid in C++ and GLSL: the viewer blends by it, and the bake
// tells by it which splats a leaf can do without.
#ifndef POINTRT_BLEND_WEIGHT_H
#define POINTRT_BLEND_WEIGHT_H

// Discs blend when their normals differ by less than 60 degrees, so that the two sides of an edge or of a thin sheet
// stay apart. Without orientation the sign of the normals says nothing and is left out.
#define BLEND_SAME_SIDE_COSINE 0.5f

// What the weights at a point lack to this the disc hit first fills up. Below the least sum of weights that an even
// sampling leaves anywhere, 0.63 (kOverlap in the bake sees to that).
#define BLEND_WEIGHT_FLOOR 0.5f

// The weight is (1 - d^2/r^2)^2 (1 - h^2/s^2)^2, d in the disc, h across it, s its slab's half height: zero with zero
// slope at the rim and at the slab's faces. in_plane and in_slab are the two differences, each above 0. Macros, for
// floats and vectors of any width.
#define BLEND_WEIGHT(in_plane, in_slab) (((in_plane) * (in_slab)) * ((in_plane) * (in_slab)))
// Whether a splat has that weight, or none: facing is the cosine between its normal and the surface's side.
#define BLEND_IS_IN_REACH(in_plane, in_slab) ((in_plane) > 0.0f && (in_slab) > 0.0f)
#define BLEND_COUNTS(facing, in_plane, in_slab)                                                                        \
    ((facing) > BLEND_SAME_SIDE_COSINE && BLEND_IS_IN_REACH(in_plane, in_slab))

#endif
