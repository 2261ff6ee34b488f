// SPDX-License-Identifier: Apache-2.0
// From the film to screen pixels, all on the device: resolve, denoise, tone map.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/image/film_views.h"
#include "runtime/render/denoiser.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/window/live/trace_speed.h"
#include "shaders/shared/display_layout.h"

namespace pointrt {

/// The layer of the film to show (SHOWN_* of runtime/image/film_views.h), and how to show it.
struct Look {
    std::uint32_t shown = SHOWN_BEAUTY;
    float exposure = 0;                ///< stops
    double depth_black = 1;            ///< depth shown as black, input units
    double scale = 1;                  ///< input units per render unit
    bool compresses_highlights = true; ///< ToneMapping::compresses_highlights

    bool operator==(const Look&) const = default;
};

/// Whether this view of the film needs first hits.
bool needsFirstHits(const Look& look);

/// Buffers for films of up to a fixed number of pixels.
struct DisplayPipeline {
    Program resolve, resolve_guides, tonemap;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet resolve_set{}, resolve_guides_set{}, tonemap_set{}, tonemap_denoised_set{};
    Buffer color, surface, albedo;
    Buffer pixels; ///< 0xAARRGGBB per pixel, sRGB
    VkDescriptorPool denoised_pool = VK_NULL_HANDLE;
    std::optional<Denoiser> denoiser;
};

/// The film and first hits in frame must outlive it.
DisplayPipeline createDisplayPipeline(Device& device, const FrameBuffers& frame, std::uint64_t film_pixels);
/// Call after the film has been reallocated.
void bindFilm(Device& device, DisplayPipeline& pipeline, const FrameBuffers& frame);
void destroyDisplayPipeline(Device& device, DisplayPipeline& pipeline);
/// Creates the denoiser for pictures of this size, unless it exists.
void prepareDenoiser(Device& device, DisplayPipeline& pipeline, PixelSize size);
std::uint64_t deviceBytes(const DisplayPipeline& pipeline);

/// Pixels [first, first + count) of a film.
struct FilmRange {
    std::uint32_t first = 0, count = 0, film_pixels = 0;
    std::uint32_t samples = 1;
};

/// Records film -> color. guides: also writes the denoiser's guide layers, which need first hits.
void recordResolve(VkCommandBuffer commands, const DisplayPipeline& pipeline, const FilmRange& range, const Look& look,
                   bool guides);
/// Records color, or the denoiser's result, -> pixels.
void recordTonemap(VkCommandBuffer commands, const DisplayPipeline& pipeline, const FilmRange& range, const Look& look,
                   bool denoised);

} // namespace pointrt
