// SPDX-License-Identifier: Apache-2.0
// Finds the point that each pixel shows: the nearest one, unless it is seen through gaps in a nearer surface. Also sums
// the colours of tiles. A lane for each pixel, by tiles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_basic : require
#include "shaders/display/point_cache.glsl"

// A neighbouring pixel whose depth is smaller by more than this factor occludes a point. On floors seen at a grazing
// angle, neighbours differ by less.
const float kOccludedDepthRatio = 1.02;
// Next to a straight edge of an occluder, nearer points lie in at most this many of the 8 directions or octants.
const int kMostNearer = 5;
// Distance in pixels within which to search for nearer points if points are sparse, that is, at most one per
// kSparsePixels pixels.
const int kSparseReach = 6;
const uint kSparsePixels = 4u;

int isNearer(uint pixel, float depth) { return nearestDepth(pixel) * kOccludedDepthRatio < depth ? 1 : 0; }
int isFilled(uint pixel) { return nearest[pixel].x != NO_INDEX ? 1 : 0; }

uint octantWith(ivec2 place, ivec2 along, float depth) {
    uvec2 at = uvec2(place + along); // beyond the upper and left edges, coordinates wrap to large numbers
    if (!isInPicture(at) || isNearer(pixelAt(at), depth) == 0) return 0u;
    bool steep = abs(along.y) > abs(along.x);
    return 1u << ((along.x < 0 ? 1 : 0) | (along.y < 0 ? 2 : 0) | (steep ? 4 : 0));
}

// Whether nearer points surround a pixel whose neighbours are mostly empty: counts the octants of a growing square that
// contain any.
bool isAmongNearerPoints(uvec2 place, float depth) {
    uint octants = 0u;
    ivec2 at = ivec2(place);
    for (int reach = 1; reach <= kSparseReach && bitCount(octants) <= kMostNearer; ++reach)
        for (int along = -reach; along < reach; ++along)
            octants |= octantWith(at, ivec2(along, -reach), depth) | octantWith(at, ivec2(reach, along), depth) |
                       octantWith(at, ivec2(-along, reach), depth) | octantWith(at, ivec2(-reach, -along), depth);
    return bitCount(octants) > kMostNearer;
}

// True for a point behind a surface that it is seen through: most of its neighbours are clearly nearer.
bool isOccluded(uvec2 place, float depth) {
    if (any(equal(place, uvec2(0))) || !isInPicture(place + 1u)) return false;
    uint at = pixelAt(place), w = params.width;
    int adjacent = isNearer(at - 1u, depth) + isNearer(at + 1u, depth) + isNearer(at - w, depth) + isNearer(at + w, depth);
    if (adjacent >= 2)
        return adjacent + isNearer(at - w - 1u, depth) + isNearer(at - w + 1u, depth) + isNearer(at + w - 1u, depth) +
                   isNearer(at + w + 1u, depth) > kMostNearer;
    bool is_sparse = pointCount() < pixelCount() / kSparsePixels;
    bool is_alone = isFilled(at - 1u) + isFilled(at + 1u) + isFilled(at - w) + isFilled(at + w) < 2;
    return is_sparse && is_alone && isAmongNearerPoints(place, depth);
}

// Adds the subgroup's results to its tile.
void addToTile(bool is_seen, uvec3 color, bool is_surface) {
    uvec3 sum = subgroupAdd(is_seen ? color : uvec3(0));
    uint count = subgroupAdd(is_seen ? 1u : 0u), surfaces = subgroupAdd(is_surface ? 1u : 0u);
    if (!subgroupElect() || count == 0u) return;
    uint tile = lane() / TILE_PIXELS;
    atomicAdd(tiles[tile].red, sum.r);
    atomicAdd(tiles[tile].green, sum.g);
    atomicAdd(tiles[tile].blue, sum.b);
    atomicAdd(tiles[tile].count, count);
    atomicAdd(tiles[tile].surfaces, surfaces);
}

void main() {
    bool is_inside = isLaneInPicture();
    uvec2 place = is_inside ? laneInTile() : uvec2(0);
    uint pixel = pixelAt(place), point = nearest[pixel].y;
    bool is_seen = is_inside && point != NO_INDEX && !isOccluded(place, nearestDepth(pixel));
    uint color = is_seen ? point_colors[point] : kBlack;
    if (is_inside) {
        shown[pixel] = color;
        seen[pixel] = is_seen ? point : NO_INDEX;
    }
    if (is_seen) is_visible[point] = 1u;
    addToTile(is_seen, channelsOf(color), is_seen && (infoOf(point) & POINT_IS_SKY) == 0u);
    uint empty = subgroupAdd(is_inside && !is_seen ? 1u : 0u);
    if (subgroupElect() && empty > 0u) atomicAdd(control.empty, empty);
}
