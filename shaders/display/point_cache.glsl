// SPDX-License-Identifier: Apache-2.0
// The buffers of the render cache, which all its programs bind, and shared functions.
#ifndef POINTRT_SHADERS_POINT_CACHE_GLSL
#define POINTRT_SHADERS_POINT_CACHE_GLSL
#include "shaders/shared/bindings.h"
#include "shaders/shared/params.h"
#include "shaders/shared/reprojection_layout.h"

layout(local_size_x = REPROJECT_GROUP) in;
layout(push_constant) uniform Push { ReprojectionPush push; };

layout(std430, binding = BINDING_CACHE_PARAMS) readonly buffer ParamsBuffer { ReprojectionParams params; };
layout(std430, binding = BINDING_CACHE_CONTROL) buffer ControlBuffer { ReprojectionControl control; };
// xyz: position in render space, w: info
layout(std430, binding = BINDING_CACHE_POINTS) buffer PointBuffer { vec4 points[]; };
layout(std430, binding = BINDING_CACHE_COLORS) buffer PointColorBuffer { uint point_colors[]; };
layout(std430, binding = BINDING_CACHE_VISIBLE) buffer VisibleBuffer { uint is_visible[]; }; // by point, 0 or 1
// By point: the pixel it is projected to, or NO_INDEX, and its depth.
layout(std430, binding = BINDING_CACHE_PROJECTED) buffer ProjectedBuffer { uvec2 projected[]; };
// By pixel: depth and number of the nearest point, both NO_INDEX if none. Positive floats sort like their bits.
layout(std430, binding = BINDING_CACHE_NEAREST) buffer NearestBuffer { uvec2 nearest[]; };
layout(std430, binding = BINDING_CACHE_SEEN) buffer SeenBuffer { uint seen[]; };    // by pixel: its point, or NO_INDEX
layout(std430, binding = BINDING_CACHE_SHOWN) buffer ShownBuffer { uint shown[]; }; // by pixel: 0xAARRGGBB
layout(std430, binding = BINDING_CACHE_TILES) buffer TileBuffer { TileColors tiles[]; };
layout(std430, binding = BINDING_CACHE_TILE_MEANS) buffer TileMeanBuffer { uint tile_means[]; };
layout(std430, binding = BINDING_CACHE_ERRORS) buffer ErrorBuffer { float errors[]; };     // by tile, steps of 255
layout(std430, binding = BINDING_CACHE_RECORDED) buffer RecordedBuffer { uint recorded[]; }; // the same, in this frame
layout(std430, binding = BINDING_CACHE_PRIORITIES) buffer PriorityBuffer { float priorities[]; };
layout(std430, binding = BINDING_CACHE_ROW_SUMS) buffer RowSumBuffer { RowSum row_sums[]; };
layout(std430, binding = BINDING_CACHE_PIXEL_LIST) buffer PixelListBuffer { uint pixel_list[]; }; // x, and y above
// One point per pixel, to replace all points: as points, and its depth.
layout(std430, binding = BINDING_CACHE_NEW_POINTS) buffer NewPointBuffer { vec4 new_points[]; };
layout(std430, binding = BINDING_CACHE_NEW_DEPTHS) buffer NewDepthBuffer { float new_depths[]; };
layout(std430, binding = BINDING_FILM) readonly buffer FilmBuffer { vec4 film[]; };
layout(std430, binding = BINDING_FIRST_HITS) readonly buffer FirstHitBuffer { vec4 first_hits[]; };
layout(std430, binding = BINDING_TONEMAP_PIXELS) buffer PixelBuffer { uint pixels[]; };

const float kSkyDepth = 1e30; // the depth of the sky, beyond all surfaces
const uint kBlack = 0xFF000000u;

uint lane() { return gl_GlobalInvocationID.x; }
uint pixelCount() { return params.width * params.height; }
uint pointCount() { return min(control.point_count, params.points); }
uint infoOf(uint point) { return floatBitsToUint(points[point].w); }
bool hasPoint(uint pixel) { return seen[pixel] != NO_INDEX; }
// Depth of the nearest point in a pixel; without a point, a depth behind everything.
float nearestDepth(uint pixel) { return nearest[pixel].x == NO_INDEX ? 2.0 * kSkyDepth : uintBitsToFloat(nearest[pixel].x); }

uvec2 placeOf(uint pixel) { return uvec2(pixel % params.width, pixel / params.width); }
uint pixelAt(uvec2 place) { return place.y * params.width + place.x; }
uint tileAt(uvec2 place) { return place.y / TILE_SIDE * params.tiles_across + place.x / TILE_SIDE; }
uvec2 tilePlace(uint tile) { return uvec2(tile % params.tiles_across, tile / params.tiles_across); }
bool isInPicture(uvec2 place) { return place.x < params.width && place.y < params.height; }

// Lanes by tile: those of a subgroup lie in one tile.
uvec2 laneInTile() {
    uint at = lane() % TILE_PIXELS;
    return tilePlace(lane() / TILE_PIXELS) * TILE_SIDE + uvec2(at % TILE_SIDE, at / TILE_SIDE);
}
bool isLaneInPicture() { return lane() / TILE_PIXELS < params.tiles_across * params.tiles_down && isInPicture(laneInTile()); }

uvec3 channelsOf(uint color) { return uvec3(color >> 16 & 255u, color >> 8 & 255u, color & 255u); }
uint packColor(uvec3 c) { return kBlack | c.r << 16 | c.g << 8 | c.b; }
// a * (256 - share) + b * share, in units of 1/256.
uint mixColors(uint a, uint b, uint share) {
    return packColor((channelsOf(a) * (256u - share) + channelsOf(b) * share + 128u) >> 8);
}

// Must agree with shaders/lib/camera_ray.glsl, except that each length of the direction advances the depth by 1.
vec2 onPlane(uvec2 place, float half_height) {
    vec2 at = (vec2(place) + 0.5) / vec2(params.width, params.height);
    return vec2(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y) * half_height * vec2(params.aspect, 1.0);
}
vec3 displaced(vec3 middle, vec2 plane) { return middle + plane.x * params.right + plane.y * params.up; }
vec3 rayOrigin(uvec2 place) { return displaced(params.eye, onPlane(place, params.half_window)); }
vec3 rayDirection(uvec2 place) { return displaced(params.forward, onPlane(place, params.tan_half_fov)); }

#endif
