// SPDX-License-Identifier: Apache-2.0
// Low-discrepancy samples: an Owen-scrambled Sobol sequence for each pixel and pair of dimensions. Its first 2^k
// samples, and every following 2^k, put one point into each elementary interval of area 2^-k. Pairs of dimensions are
// padded: each sequence is shuffled independently, so that pairs are uncorrelated.
// After Burley, Practical Hash-Based Owen Scrambling (JCGT 9(4), 2020).
#ifndef POINTRT_SHADERS_SAMPLER_GLSL
#define POINTRT_SHADERS_SAMPLER_GLSL

#include "shaders/lib/random.glsl"

// Owen scrambling of a bit-reversed number: flips each bit depending on a hash of the bits below it. Vegdahl's hash
// (Building a Better LK Hash, 2021) is better than that of Laine and Karras at the same cost.
uint scrambleReversed(uint x, uint seed) {
    x ^= x * 0x3D20ADEAu;
    x += seed;
    x *= seed >> 16u | 1u;
    x ^= x * 0x05526C56u;
    x ^= x * 0x53A22864u;
    return x;
}

// The second Sobol dimension, bit-reversed: bit j is the sum of the bits k of index with odd C(k, j), the Pascal matrix
// modulo 2. C(k, j) is odd if the bits of j are a subset of those of k (Lucas), so five butterfly steps compute it.
uint pascalBits(uint index) {
    index ^= index >> 16u;
    index ^= index >> 8u & 0x00FF00FFu;
    index ^= index >> 4u & 0x0F0F0F0Fu;
    index ^= index >> 2u & 0x33333333u;
    index ^= index >> 1u & 0x55555555u;
    return index;
}

// 24 bits: the most that floats in [0, 1) represent with even spacing.
float unitFloat(uint bits) { return float(bits >> 8u) * (1.0 / 16777216.0); }

// Two numbers in [0, 1).
vec2 sample2(uint pixel, uint sample_index, uint dimension_pair, uint seed) {
    uvec3 hash = pcg3(uvec3(pixel, dimension_pair, seed));
    uint index = bitfieldReverse(scrambleReversed(bitfieldReverse(sample_index), hash.x));
    uint x = bitfieldReverse(scrambleReversed(index, hash.y));
    uint y = bitfieldReverse(scrambleReversed(pascalBits(index), hash.z));
    return vec2(unitFloat(x), unitFloat(y));
}

// Only the first number of the pair, in [0, 1). The pair counts as used.
float sample1(uint pixel, uint sample_index, uint dimension_pair, uint seed) {
    uvec3 hash = pcg3(uvec3(pixel, dimension_pair, seed));
    uint index = bitfieldReverse(scrambleReversed(bitfieldReverse(sample_index), hash.x));
    return unitFloat(bitfieldReverse(scrambleReversed(index, hash.y)));
}

#endif
