// SPDX-License-Identifier: Apache-2.0
// The nearest shape on each ray, or none: the first to look, before the instances.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "path.glsl"
#include "shapes.glsl"
#include "offset.glsl"

layout(local_size_x = WORKGROUP_SIZE) in;

void main() {
    uint index;
    PathState path = currentPath(index);
    if (index == NO_INDEX) return;
    uint skipped = hasStep(STEP_FIRST_HIT) ? SHAPE_BACKDROP | SHAPE_UNSEEN_BY_CAMERA
                                           : (isCameraPass() ? SHAPE_UNSEEN_BY_CAMERA : 0u);
    uint shapes = params.scene.z;
    float t_min = pathBits(path) >> PATH_OWNER_SHIFT == OWNER_SHAPES ? ownShapeReach(path.origin.xyz) : 0.0;
    ShapeHit hit = nearestShapeWithout(skipped, shapes, path.origin.xyz, path.direction.xyz, t_min);
    imageStore(hit_texels, int(index),
               hit.shape >= shapes ? kNoHit : uvec4(floatBitsToUint(hit.t), 0u, hit.shape, OWNER_SHAPES));
}
