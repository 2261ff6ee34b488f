// SPDX-License-Identifier: Apache-2.0
// The points around an empty pixel.
#ifndef POINTRT_SHADERS_NEIGHBORS_GLSL
#define POINTRT_SHADERS_NEIGHBORS_GLSL
#include "shaders/display/point_cache.glsl"

// Neighbouring depths within this ratio belong to one surface.
const float kSameSurfaceRatio = 1.03;

// The points around the pixel. Sums and sides include only those on the farthest surface.
struct Neighbors {
    uvec3 color;
    uint count;
    float depth; // a sum
    float nearest;
    float farthest; // like nearest, over all neighbours
    uint sides;     // where points were found: a bit for each of the 3 x 3 positions, by row
    uint point;     // one of them
};

Neighbors noNeighbors() { return Neighbors(uvec3(0), 0u, 0.0, kSkyDepth, 0.0, 0u, NO_INDEX); }

void addNeighbor(inout Neighbors found, uint pixel, uint side) {
    if (!hasPoint(pixel)) return;
    float depth = nearestDepth(pixel);
    found.nearest = min(found.nearest, depth);
    if (depth * kSameSurfaceRatio < found.farthest) return;
    if (depth > found.farthest * kSameSurfaceRatio) // well behind the points so far
        found = Neighbors(uvec3(0), 0u, 0.0, found.nearest, found.farthest, 0u, NO_INDEX);
    found.farthest = max(found.farthest, depth);
    found.color += channelsOf(shown[pixel]);
    found.depth += depth;
    found.point = seen[pixel];
    ++found.count;
    found.sides |= 1u << side;
}

// Adds the points to the left and right, above and below, and in the four diagonal directions, at this distance along x
// and y.
void addRing(inout Neighbors found, uvec2 place, uint radius) {
    for (uint side = 0u; side < 9u; ++side) { // 3 x 3
        ivec2 at = ivec2(place) + (ivec2(side % 3u, side / 3u) - 1) * int(radius);
        at.x = at.x < 0 || at.x >= int(params.width) ? int(place.x) : at.x;
        at.y = at.y < 0 || at.y >= int(params.height) ? int(place.y) : at.y;
        addNeighbor(found, pixelAt(uvec2(at)), side);
    }
}

// True if all points are on one surface, and two of them face each other across the pixel.
bool isContinuous(Neighbors found) {
    uint turned = bitfieldReverse(found.sides) >> 23; // the 9 bits in reverse order
    return (found.sides & turned) != 0u && found.nearest * kSameSurfaceRatio >= found.farthest;
}

#endif
