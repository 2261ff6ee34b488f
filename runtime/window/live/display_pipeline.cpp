// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/display_pipeline.h"

#include <cmath>

#include "runtime/util/on_error.h"
#include "shaders/resolve.spv.h"
#include "shaders/shared/params.h"
#include "shaders/tonemap.spv.h"

namespace pointrt {
namespace {

Buffer createTexels(Device& device, const char* what, std::uint64_t pixels) {
    Buffer buffer = createBuffer(device, what, pixels * sizeof(gpu::vec4),
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT);
    createTexelView(device, what, buffer, VK_FORMAT_R32G32B32A32_SFLOAT);
    return buffer;
}

VkDescriptorSet createResolveSet(Device& device, const DisplayPipeline& d, const Program& program,
                                 const FrameBuffers& frame) {
    return createDescriptorSet(device, d.pool, program,
                               {{BINDING_RESOLVE_FILM, &frame.film},
                                {BINDING_RESOLVE_FIRST_HITS, &frame.first_hits},
                                {BINDING_RESOLVE_COLORS, &d.color},
                                {BINDING_RESOLVE_SURFACES, &d.surface},
                                {BINDING_RESOLVE_ALBEDOS, &d.albedo}});
}

void createAll(Device& device, DisplayPipeline& d, const FrameBuffers& frame, std::uint64_t film_pixels) {
    d.color = createTexels(device, "picture buffer", film_pixels);
    d.surface = createTexels(device, "surface guides", film_pixels);
    d.albedo = createTexels(device, "albedo guides", film_pixels);
    d.pixels =
        createBuffer(device, "pixel buffer", film_pixels * sizeof(std::uint32_t), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    d.resolve = createProgram(device, "resolve", resolve_spv, {{SPEC_HAS_FIRST_HITS, 0}});
    d.resolve_guides = createProgram(device, "resolve", resolve_spv, {{SPEC_HAS_FIRST_HITS, 1}});
    d.tonemap = createProgram(device, "tonemap", tonemap_spv);
    bindFilm(device, d, frame);
}

void dropDenoiser(Device& device, DisplayPipeline& pipeline) {
    if (pipeline.denoiser) destroyDenoiser(device, *pipeline.denoiser);
    pipeline.denoiser.reset();
    destroyDescriptorPool(device, pipeline.denoised_pool);
}

std::uint32_t displayOf(ShownAs as, const Look& look) {
    if (as == ShownAs::kNumber) return DISPLAY_AS_STORED;
    return look.compresses_highlights ? DISPLAY_COMPRESSED : DISPLAY_CLIPPED;
}

GroupCount groupsOf(const FilmRange& range) { return {(range.count + DISPLAY_GROUP - 1) / DISPLAY_GROUP, 1, 1}; }

} // namespace

bool needsFirstHits(const Look& look) { return kFilmViews.at(look.shown).group == FilmGroup::kFirstHits; }

DisplayPipeline createDisplayPipeline(Device& device, const FrameBuffers& frame, std::uint64_t film_pixels) {
    DisplayPipeline pipeline;
    const OnError undo([&] { destroyDisplayPipeline(device, pipeline); });
    createAll(device, pipeline, frame, film_pixels);
    return pipeline;
}

void bindFilm(Device& device, DisplayPipeline& d, const FrameBuffers& frame) {
    destroyDescriptorPool(device, d.pool);
    d.pool = createDescriptorPool(device, 3);
    d.resolve_set = createResolveSet(device, d, d.resolve, frame);
    d.resolve_guides_set = createResolveSet(device, d, d.resolve_guides, frame);
    d.tonemap_set = createDescriptorSet(device, d.pool, d.tonemap,
                                        {{BINDING_TONEMAP_COLORS, &d.color}, {BINDING_TONEMAP_PIXELS, &d.pixels}});
}

void destroyDisplayPipeline(Device& device, DisplayPipeline& pipeline) {
    dropDenoiser(device, pipeline);
    destroyDescriptorPool(device, pipeline.pool);
    for (Program* program : {&pipeline.resolve, &pipeline.resolve_guides, &pipeline.tonemap})
        destroyProgram(device, *program);
    for (Buffer* buffer : {&pipeline.color, &pipeline.surface, &pipeline.albedo, &pipeline.pixels})
        destroyBuffer(device, *buffer);
}

void prepareDenoiser(Device& device, DisplayPipeline& d, PixelSize size) {
    if (d.denoiser && PixelSize{d.denoiser->width, d.denoiser->height} == size) return;
    dropDenoiser(device, d);
    d.denoiser = createDenoiser(device, size.width, size.height, {&d.color, &d.surface, &d.albedo, true});
    d.denoised_pool = createDescriptorPool(device, 1);
    d.tonemap_denoised_set =
        createDescriptorSet(device, d.denoised_pool, d.tonemap,
                            {{BINDING_TONEMAP_COLORS, &d.denoiser->result}, {BINDING_TONEMAP_PIXELS, &d.pixels}});
}

std::uint64_t deviceBytes(const DisplayPipeline& d) {
    std::uint64_t bytes = d.color.bytes + d.surface.bytes + d.albedo.bytes + d.pixels.bytes;
    if (!d.denoiser) return bytes;
    for (const Buffer* buffer : {&d.denoiser->surface, &d.denoiser->slope, &d.denoiser->factor, &d.denoiser->light[0],
                                 &d.denoiser->light[1], &d.denoiser->result})
        bytes += buffer->bytes;
    return bytes;
}

void recordResolve(VkCommandBuffer commands, const DisplayPipeline& d, const FilmRange& range, const Look& look,
                   bool guides) {
    const auto samples = static_cast<float>(range.samples);
    const gpu::ResolveParams params{range.first,
                                    range.count,
                                    range.film_pixels,
                                    look.shown,
                                    1 / samples,
                                    samples,
                                    static_cast<float>(look.scale),
                                    static_cast<float>(look.depth_black / look.scale)};
    const bool reads_hits = guides || needsFirstHits(look);
    recordDispatch(commands, reads_hits ? d.resolve_guides : d.resolve,
                   reads_hits ? d.resolve_guides_set : d.resolve_set, pushBytes(params), groupsOf(range));
    recordBarrier(commands);
}

void recordTonemap(VkCommandBuffer commands, const DisplayPipeline& d, const FilmRange& range, const Look& look,
                   bool denoised) {
    const ShownAs as = kFilmViews.at(look.shown).as;
    const gpu::TonemapParams params{range.first, range.count, as == ShownAs::kLight ? std::exp2(look.exposure) : 1.0f,
                                    displayOf(as, look)};
    recordDispatch(commands, d.tonemap, denoised ? d.tonemap_denoised_set : d.tonemap_set, pushBytes(params),
                   groupsOf(range));
    recordBarrier(commands);
}

} // namespace pointrt
