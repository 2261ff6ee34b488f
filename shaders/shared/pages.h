// SPDX-License-Identifier: Apache-2.0
// Texel buffers in pages. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_PAGES_H
#define POINTRT_SHADERS_PAGES_H

// Pages of a buffer. Seven buffers' (PAGED_BUFFERS) and what programs bind besides come to 86 resources of the 128 that
// drivers allow a program at least; with pages of 2^27 texels, cell discs have room for 2^31, as many as an index
// lists (PRO_INDEX_LISTED_MAX).
#define MAX_PAGES 8
#define PAGED_BUFFERS 7

#endif
