// SPDX-License-Identifier: Apache-2.0
// Tiles that lie in one block (runtime/gpu/texel_pool.h): a lane selects a tile and then reads it as other programs
// read their instance.
#ifndef POINTRT_SHADERS_POOL_GLSL
#define POINTRT_SHADERS_POOL_GLSL

layout(set = SET_PAGES, binding = BINDING_POOLED_TILES) uniform usamplerBuffer pooled_tiles; // PooledTile

// The members of InstanceParams except its arrays and the harmonics, and the starts of the sections.
struct PooledInstance {
    vec4 row_x;
    vec4 row_y;
    vec4 row_z;
    vec4 splat;
    vec4 grid_scale;
    uvec4 grid_origin;
    uvec4 grid_size;
    uvec4 grid_words;
    uvec4 materials;
    vec4 core_low;
    vec4 core_high;
    uvec4 words;
    uvec4 quads;
    uint listed;
};

PooledInstance instance; // of the lane's tile
int pooled_row = 0;      // of that tile in the table

uvec4 pooledRow(int row) { return texelFetch(pooled_tiles, pooled_row + row); }
vec4 pooledVector(int row) { return uintBitsToFloat(pooledRow(row)); }

const int kGridSizeRow = 6, kGridWordsRow = 7, kWordsRow = INSTANCE_VECTORS, kQuadsRow = INSTANCE_VECTORS + 1;
const int kColorRangeRow = INSTANCE_VECTORS - MAX_CLIP_PLANES - MAX_COLOR_RANGES;
const int kClipPlaneRow = INSTANCE_VECTORS - MAX_CLIP_PLANES;

// place: index of the tile among those of the program.
void selectTile(uint place) {
    pooled_row = int(place) * POOLED_TILE_VECTORS;
    instance = PooledInstance(pooledVector(0), pooledVector(1), pooledVector(2), pooledVector(3), pooledVector(4),
                              pooledRow(5), pooledRow(kGridSizeRow), pooledRow(kGridWordsRow), pooledRow(8),
                              pooledVector(9), pooledVector(10), pooledRow(kWordsRow), pooledRow(kQuadsRow),
                              pooledRow(INSTANCE_VECTORS + 2).x);
}

// A lane loads the data of its tile and its ray again where it needs them: with the 64 registers of a walk, GPUs keep
// more rays in flight than with the 96 registers that would hold everything in between. Compilers would merge loads
// from the same address, so the address depends on the sign of a row, which compilers do not know is never negative.
uint again(uint index) { return index + (pooled_row < 0 ? 1u : 0u); }

// Loads what the walk needs from cell to cell.
void reloadGrid() {
    pooled_row = int(again(uint(pooled_row)));
    instance.grid_size = pooledRow(kGridSizeRow);
    instance.grid_words = pooledRow(kGridWordsRow);
    instance.words = pooledRow(kWordsRow);
}

// Loads what the walk needs for the list of a cell.
void reloadLists() {
    pooled_row = int(again(uint(pooled_row)));
    instance.quads = pooledRow(kQuadsRow);
}

#define loadClipPlane(i) pooledVector(kClipPlaneRow + int(i))
#define loadColorRange(i) pooledRow(kColorRangeRow + int(i))
#define loadGrid(i) LOAD_IMAGE_WORD(grid_array, grid_words, (i) + instance.words.x)
#define loadBrickWord(i) LOAD_IMAGE_WORD(brick_array, brick_words, (i) + instance.words.y)
#define loadSlab(i) LOAD_IMAGE_WORD(slab_array, slab_words, (i) + instance.words.z)
#define loadBlending(i) LOAD_IMAGE_WORD(blending_array, blending_words, (i) + instance.words.w)
#define loadCell(i) LOAD_TEXEL(cell_array, cell_words, (i) + instance.quads.x)
#define loadNearPair(i) LOAD_IMAGE(near_array, near_words, (i) + instance.quads.y)
#define loadSplat(i) LOAD_IMAGE(splat_array, splat_words, (i) + instance.quads.z)
#define loadListed(i) \
    (kReadsStorage ? listed_array[(i) + instance.listed] : texelFetch(listed_words, int((i) + instance.listed)).x)
#define loadNoise(i) \
    (texelFetch(noise_words, int(((i) >> 4) + instance.quads.w))[(i) >> 2 & 3u] >> (8u * ((i) & 3u)) & 0xFFu)

#endif
