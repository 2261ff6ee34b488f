// SPDX-License-Identifier: Apache-2.0
// Low-discrepancy numbers: for each pixel and pair of dimensions an Owen-scrambled Sobol sequence of its own, whose
// samples 0 to 2^k - 1, and every following 2^k, fill each elementary interval of area 2^-k once. Pairs of dimensions
// are padded: each sequence is shuffled by itself, so that nothing of one tells of another.
// After Burley, Practical Hash-Based Owen Scrambling (JCGT 9(4), 2020).
#ifndef POINTRT_SHADERS_SAMPLER_GLSL
#define POINTRT_SHADERS_SAMPLER_GLSL

#include "shaders/lib/random.glsl"

// Owen scrambling of a number whose bits are reversed: a bit is flipped by a hash of the bits below it. This is
// Vegdahl's hash (Building a Better LK Hash, 2021), of better quality than Laine and Karras's at the same cost.
uint scrambleReversed(uint x, uint seed) {
    x ^= x * 0x3D20ADEAu;
    x += seed;
    x *= seed >> 16u | 1u;
    x ^= x * 0x05526C56u;
    x ^= x * 0x53A22864u;
    return x;
}

// The second Sobol dimension, reversed: bit j is the sum of index's bits k with odd C(k, j), the Pascal matrix modulo
// 2. C(k, j) is odd where j's bits are among k's (Lucas), so sums over halves make it in five steps.
uint pascalBits(uint index) {
    index ^= index >> 16u;
    index ^= index >> 8u & 0x00FF00FFu;
    index ^= index >> 4u & 0x0F0F0F0Fu;
    index ^= index >> 2u & 0x33333333u;
    index ^= index >> 1u & 0x55555555u;
    return index;
}

// 24 bits are what a float below 1 holds evenly.
float unitFloat(uint bits) { return float(bits >> 8u) * (1.0 / 16777216.0); }

// Two numbers in [0, 1).
vec2 sample2(uint pixel, uint sample_index, uint dimension_pair, uint seed) {
    uvec3 hash = pcg3(uvec3(pixel, dimension_pair, seed));
    uint index = bitfieldReverse(scrambleReversed(bitfieldReverse(sample_index), hash.x));
    uint x = bitfieldReverse(scrambleReversed(index, hash.y));
    uint y = bitfieldReverse(scrambleReversed(pascalBits(index), hash.z));
    return vec2(unitFloat(x), unitFloat(y));
}

// The first of the pair: one number in [0, 1) for decisions that need no more. It uses up the pair's number.
float sample1(uint pixel, uint sample_index, uint dimension_pair, uint seed) {
    uvec3 hash = pcg3(uvec3(pixel, dimension_pair, seed));
    uint index = bitfieldReverse(scrambleReversed(bitfieldReverse(sample_index), hash.x));
    return unitFloat(bitfieldReverse(scrambleReversed(index, hash.y)));
}

#endif
