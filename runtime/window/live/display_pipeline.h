// SPDX-License-Identifier: Apache-2.0
// From the film on the device to the pixels of a screen: means, denoiser, tone curve. Nothing comes to the host.
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/image/film_views.h"
#include "runtime/render/denoiser.h"
#include "runtime/render/frame_buffers.h"
#include "runtime/window/live/trace_speed.h"
#include "shaders/shared/display_layout.h"

namespace pointrt {

/// What of the film is shown: SHOWN_* of runtime/image/film_views.h, and how.
struct Look {
    std::uint32_t shown = SHOWN_BEAUTY;
    float exposure = 0;     ///< stops
    double depth_black = 1; ///< input units at which the depth view is black
    double scale = 1;       ///< input units in a render unit

    bool operator==(const Look&) const = default;
};

/// True where the film must have first hits for it.
bool needsFirstHits(const Look& look);

/// For films of up to a number of pixels.
struct DisplayPipeline {
    Program resolve, resolve_guides, tonemap;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet resolve_set{}, resolve_guides_set{}, tonemap_set{}, tonemap_denoised_set{};
    Buffer color, surface, albedo;
    Buffer pixels; ///< a word 0xAARRGGBB a pixel, sRGB
    VkDescriptorPool denoised_pool = VK_NULL_HANDLE;
    std::optional<Denoiser> denoiser;
};

/// film and first_hits (of frame): must live as long as it is used.
DisplayPipeline createDisplayPipeline(Device& device, const FrameBuffers& frame, std::uint64_t film_pixels);
void destroyDisplayPipeline(Device& device, DisplayPipeline& pipeline);
/// For pictures of this size; replaces the one there is, where it has another size.
void prepareDenoiser(Device& device, DisplayPipeline& pipeline, PixelSize size);
std::uint64_t deviceBytes(const DisplayPipeline& pipeline);

/// Pixels first to first + count of a film.
struct FilmRange {
    std::uint32_t first = 0, count = 0, film_pixels = 0;
    std::uint32_t samples = 1;
};

/// Records the way from film to color. guides: also what the denoiser wants; the film has first hits then.
void recordResolve(VkCommandBuffer commands, const DisplayPipeline& pipeline, const FilmRange& range, const Look& look,
                   bool guides);
/// Records the way from color, or from the denoiser's result, to pixels.
void recordTonemap(VkCommandBuffer commands, const DisplayPipeline& pipeline, const FilmRange& range, const Look& look,
                   bool denoised);

} // namespace pointrt
