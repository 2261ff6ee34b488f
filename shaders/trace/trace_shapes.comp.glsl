// SPDX-License-Identifier: Apache-2.0
// The nearest shape on each ray, or none: the first to look, before the instances. Lists the rays that may meet those;
// camera rays have their beams.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/frame/path.glsl"
#include "shaders/trace/shapes.glsl"
#include "shaders/trace/offset.glsl"
#include "shaders/frame/append.glsl"
#include "shaders/trace/reach.glsl"

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    uint shapes = ofLane(params.shape_count);
    uint skipped = hasStep(STEP_FIRST_HIT) ? SHAPE_BACKDROP | SHAPE_UNSEEN_BY_CAMERA
                                           : (kCameraPass ? SHAPE_UNSEEN_BY_CAMERA : 0u);
    vec3 origin = path.origin, direction = path.direction;
    float t_min = path.bits >> PATH_OWNER_SHIFT == OWNER_SHAPES ? ownShapeReach(origin) : 0.0;
    ShapeHit hit = nearestShapeWithout(skipped, shapes, origin, direction, t_min);
    if (live)
        imageStore(hit_texels, int(index),
                   hit.shape >= shapes ? kNoHit : uvec4(floatBitsToUint(hit.t), 0u, hit.shape, OWNER_SHAPES));
    appendEntry(APPEND_ASKED, live && !kCameraPass && meetsInstances(origin, direction, hit.t), index);
}
