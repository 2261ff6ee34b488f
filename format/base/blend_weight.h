// SPDX-License-Identifier: Apache-2.0
// The weight of a splat in the blended surface. Valid in C++ and GLSL: the viewer blends with it, and the bake prunes
// with it.
#ifndef POINTRT_BLEND_WEIGHT_H
#define POINTRT_BLEND_WEIGHT_H

// Discs blend if their normals differ by less than 60 degrees, so that the sides of an edge or of a thin sheet stay
// separate. Without orientation the sign of the normals is ignored.
#define BLEND_SAME_SIDE_COSINE 0.5f

// If the weights at a point sum to less than this, the disc hit first gets the difference. It is below 0.63, the
// smallest sum that even sampling gives anywhere (by kOverlap in the bake).
#define BLEND_WEIGHT_FLOOR 0.5f

// (1 - d^2/r^2)^2 (1 - h^2/s^2)^2 with d the distance in the disc's plane, h the distance from the plane and s half the
// slab's height: zero with zero slope at the rim and at the slab's faces. in_plane and in_slab are the two differences,
// both above 0. Macros serve floats and vectors of any width.
#define BLEND_WEIGHT(in_plane, in_slab) (((in_plane) * (in_slab)) * ((in_plane) * (in_slab)))
// Whether a splat has a weight above 0; facing is the cosine between its normal and the surface's side.
#define BLEND_IS_IN_REACH(in_plane, in_slab) ((in_plane) > 0.0f && (in_slab) > 0.0f)
#define BLEND_COUNTS(facing, in_plane, in_slab)                                                                        \
    ((facing) > BLEND_SAME_SIDE_COSINE && BLEND_IS_IN_REACH(in_plane, in_slab))

#endif
