// SPDX-License-Identifier: Apache-2.0
// Paged texel buffers. Valid in C++ and GLSL.
#ifndef POINTRT_SHADERS_PAGES_H
#define POINTRT_SHADERS_PAGES_H

// Maximum number of pages of a buffer. The pages of all PAGED_BUFFERS and the other bindings of a program add up to 86
// resources; every driver allows 128. With pages of 2^27 texels there is room for 2^31 cell discs, the most an index
// may list (PRO_INDEX_LISTED_MAX).
#define MAX_PAGES 8
#define PAGED_BUFFERS 7

#endif
