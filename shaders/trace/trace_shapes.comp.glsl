// SPDX-License-Identifier: Apache-2.0
// The nearest shape on each ray, or none: the first to look, before the instances. Lists the rays that may meet those;
// camera rays have their beams.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/trace/shape_hit.glsl"
#include "shaders/lib/append.glsl"
#include "shaders/trace/reach.glsl"

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    uint skipped = hasStep(STEP_FIRST_HIT) ? SHAPE_BACKDROP | SHAPE_UNSEEN_BY_CAMERA
                                           : (kCameraPass ? SHAPE_UNSEEN_BY_CAMERA : 0u);
    float t_min = nearestFrom(path.bits >> PATH_OWNER_SHIFT, path.origin);
    ShapeHit hit = nearestShapeWithout(skipped, ofLane(params.shape_count), path.origin, path.direction, t_min);
    if (live) imageStore(hit_texels, int(index), hitWords(hit));
    bool asks = live && !kCameraPass && meetsInstances(path.origin, path.direction, hit.t);
    appendEntry(LIST_ASKED, asks, index);
}
