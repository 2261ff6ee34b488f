// SPDX-License-Identifier: Apache-2.0
// Closest hits on shapes, before any instance is intersected. Appends rays that may hit instances to
// LIST_INSTANCE_RAYS; camera rays go through beam and intersect_camera instead.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/trace/shape_hit.glsl"
#include "shaders/lib/append.glsl"
#include "shaders/trace/instance_bounds.glsl"

void main() {
    uint index;
    PathState path = currentPath(index);
    bool live = index != NO_INDEX;
    uint skipped = hasStep(STEP_FIRST_HIT) ? SHAPE_BACKDROP | SHAPE_UNSEEN_BY_CAMERA
                                           : (kCameraPass ? SHAPE_UNSEEN_BY_CAMERA : 0u);
    float t_min = shapeMinDistance(path.bits >> PATH_OWNER_SHIFT, path.origin);
    ShapeHit hit = nearestShapeWithout(skipped, ofLane(params.shape_count), path.origin, path.direction, t_min);
    if (live) imageStore(hit_texels, int(index), hitWords(hit));
    bool queued = live && !kCameraPass && mayHitInstances(path.origin, path.direction, hit.t);
    appendEntry(LIST_INSTANCE_RAYS, queued, index);
}
