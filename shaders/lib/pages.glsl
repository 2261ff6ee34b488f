// SPDX-License-Identifier: Apache-2.0
// Loads from buffers larger than one texel buffer. Page 0 is bound where unpaged programs bind the whole buffer
// (instance_bindings.glsl); page k >= 1 is element k - 1 of an array in set 1. Some drivers, lavapipe among them, index
// such arrays by constants only. So a load fetches from every page in use, at index 0 if the page does not hold the
// texel, and selects the right result.
#ifndef POINTRT_SHADERS_PAGES_GLSL
#define POINTRT_SHADERS_PAGES_GLSL
#include "shaders/shared/bindings.h"
#include "shaders/shared/pages.h"
#include "shaders/shared/spec_constants.h"

// A page has 2^kPageBits texels. The other constants: pages in use of each buffer, 1 to MAX_PAGES.
layout(constant_id = SPEC_PAGE_BITS) const uint kPageBits = 27u;
layout(constant_id = SPEC_BRICK_PAGES) const uint kBrickPages = 1u;
layout(constant_id = SPEC_CELL_PAGES) const uint kCellPages = 1u;
layout(constant_id = SPEC_SLAB_PAGES) const uint kSlabPages = 1u;
layout(constant_id = SPEC_NEAR_PAGES) const uint kNearPages = 1u;
layout(constant_id = SPEC_LISTED_PAGES) const uint kListedPages = 1u;
layout(constant_id = SPEC_BLENDING_PAGES) const uint kBlendingPages = 1u;
layout(constant_id = SPEC_SPLAT_PAGES) const uint kSplatPages = 1u;

layout(set = SET_PAGES, binding = BINDING_BRICK_PAGES) uniform usamplerBuffer brick_pages[MAX_PAGES - 1];
layout(set = SET_PAGES, binding = BINDING_CELL_PAGES) uniform usamplerBuffer cell_pages[MAX_PAGES - 1];
layout(set = SET_PAGES, binding = BINDING_SLAB_PAGES) uniform usamplerBuffer slab_pages[MAX_PAGES - 1];
layout(set = SET_PAGES, binding = BINDING_NEAR_PAGES) uniform usamplerBuffer near_pages[MAX_PAGES - 1];
layout(set = SET_PAGES, binding = BINDING_LISTED_PAGES) uniform usamplerBuffer listed_pages[MAX_PAGES - 1];
layout(set = SET_PAGES, binding = BINDING_BLENDING_PAGES) uniform usamplerBuffer blending_pages[MAX_PAGES - 1];
layout(set = SET_PAGES, binding = BINDING_SPLAT_PAGES) uniform usamplerBuffer splat_pages[MAX_PAGES - 1];

#define FETCH_PAGE(texels, k) \
    if (count > k) { \
        uvec4 other = texelFetch(texels, page == k ? at : 0); \
        texel = page == k ? other : texel; \
    }

// load: the function that reads the first page.
#define DEFINE_FETCH(fetch, load, first, pages, page_count) \
    uvec4 fetch(uint i) { \
        const uint count = page_count; \
        if (count == 1u) return load(first, int(i)); \
        uint page = i >> kPageBits; \
        int at = int(i & ((1u << kPageBits) - 1u)); \
        uvec4 texel = load(first, page == 0u ? at : 0); \
        FETCH_PAGE(pages[0], 1u) \
        FETCH_PAGE(pages[1], 2u) \
        FETCH_PAGE(pages[2], 3u) \
        FETCH_PAGE(pages[3], 4u) \
        FETCH_PAGE(pages[4], 5u) \
        FETCH_PAGE(pages[5], 6u) \
        FETCH_PAGE(pages[6], 7u) \
        return texel; \
    }

DEFINE_FETCH(fetchBrickWord, imageLoad, brick_words, brick_pages, kBrickPages)
DEFINE_FETCH(fetchCell, texelFetch, cell_words, cell_pages, kCellPages)
DEFINE_FETCH(fetchSlab, imageLoad, slab_words, slab_pages, kSlabPages)
DEFINE_FETCH(fetchNear, imageLoad, near_words, near_pages, kNearPages)
DEFINE_FETCH(fetchListed, texelFetch, listed_words, listed_pages, kListedPages)
DEFINE_FETCH(fetchBlending, imageLoad, blending_words, blending_pages, kBlendingPages)
DEFINE_FETCH(fetchSplat, imageLoad, splat_words, splat_pages, kSplatPages)

#define loadBrickWord(i) fetchBrickWord(i).x
#define loadCell(i) fetchCell(i)
#define loadSlab(i) fetchSlab(i).x
#define loadNearPair(i) fetchNear(i)
#define loadBlending(i) fetchBlending(i).x
#define loadListedPair(i) fetchListed(i).xy
#define loadListed(i) loadListedPair((i) >> 1)[(i) & 1u]
#define loadSplat(i) fetchSplat(i)

#endif
