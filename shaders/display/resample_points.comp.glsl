// SPDX-License-Identifier: Apache-2.0
// New points, one per pixel centre, for when gaps have become too many. Gaps within a surface get interpolated points. A
// lane for each pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/display/neighbors.glsl"

void main() {
    if (lane() >= pixelCount() || control.gaps <= params.most_gaps) return;
    uint point = seen[lane()], info = POINT_INVALID;
    uvec2 place = placeOf(lane());
    float depth = nearestDepth(lane());
    if (point != NO_INDEX) {
        info = infoOf(point);
    } else {
        Neighbors found = noNeighbors();
        addRing(found, place, 1u);
        if (isContinuous(found)) {
            info = infoOf(found.point) | POINT_INTERPOLATED;
            depth = found.depth / float(found.count);
        }
    }
    vec3 direction = rayDirection(place);
    vec3 position = (info & POINT_IS_SKY) != 0u ? direction : rayOrigin(place) + depth * direction;
    new_points[lane()] = vec4(position, uintBitsToFloat(info));
    new_depths[lane()] = depth;
}
