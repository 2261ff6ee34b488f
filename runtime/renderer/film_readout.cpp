// SPDX-License-Identifier: Apache-2.0
#include "runtime/renderer/film_readout.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "format/base/parallel.h"
#include "runtime/tracer/frame_params.h"
#include "shaders/shared/luminance.h"

namespace pointrt {

namespace {

constexpr std::size_t kPixelsAtOnce = 1 << 16; ///< of a thread: a millisecond's work, starting one takes a tenth

std::size_t firstPixel(Band band, const Film& film) { return std::size_t{band.first_row} * film.width; }
std::size_t pixelCount(Band band, const Film& film) { return std::size_t{band.rows} * film.width; }

/// buffer's vectors where the host can read them: in place, or in copy.
const gpu::vec4* readVectors(Device& device, const Buffer& buffer, std::size_t count, std::vector<gpu::vec4>& copy) {
    if (buffer.mapped) return static_cast<const gpu::vec4*>(buffer.mapped);
    copy.resize(count);
    downloadBuffer(device, buffer, copy.data(), count * sizeof copy[0]);
    return copy.data();
}

void storeMean(const gpu::vec4& sum, float share, float* rgb) {
    rgb[0] = sum.x * share;
    rgb[1] = sum.y * share;
    rgb[2] = sum.z * share;
}

gpu::vec4 restored(const float* rgb, float sum, float w) { return {rgb[0] * sum, rgb[1] * sum, rgb[2] * sum, w}; }

/// Of the mean of samples with this sum and this sum of squares.
float varianceOfMean(double sum, double squares, double samples) {
    if (samples < 2) return std::numeric_limits<float>::infinity();
    const double mean = sum / samples;
    return static_cast<float>(std::max(squares / samples - mean * mean, 0.0) / (samples - 1));
}

} // namespace

void allocateFilm(const RenderSettings& settings, Film& film) {
    const std::size_t pixels = std::size_t{settings.width} * settings.height;
    const std::size_t in_parts = settings.light_parts ? pixels : 0, in_hits = settings.first_hits ? pixels : 0;
    film.width = settings.width;
    film.height = settings.height;
    film.rgba.assign(4 * pixels, 0.0f);
    for (auto* layer : {&film.direct, &film.indirect, &film.caustic}) layer->assign(3 * in_parts, 0.0f);
    film.albedo.assign(3 * pixels, 0.0f);
    film.samples.assign(pixels, 0.0f);
    film.variance.assign(pixels, 0.0f);
    film.depth.assign(in_hits, std::numeric_limits<float>::infinity());
    film.normal.assign(3 * in_hits, 0.0f);
    film.position.assign(3 * in_hits, 0.0f);
    film.splat_id.assign(in_hits, NO_INDEX);
    film.instance_id.assign(in_hits, NO_INDEX);
}

void storeLight(Device& device, const FrameBuffers& buffers, Band band, std::uint32_t samples, Film& film) {
    const std::size_t pixels = pixelCount(band, film), first = firstPixel(band, film);
    std::vector<gpu::vec4> copy;
    const gpu::vec4* const layers = readVectors(device, buffers.film, FILM_LAYERS * pixels, copy);
    const float share = 1.0f / static_cast<float>(samples);
    const auto storePixel = [&](std::size_t i) {
        const gpu::vec4 direct = layers[LAYER_DIRECT * pixels + i], indirect = layers[LAYER_INDIRECT * pixels + i],
                        caustic = layers[LAYER_CAUSTIC * pixels + i];
        const gpu::vec4 sum{direct.x + indirect.x + caustic.x, direct.y + indirect.y + caustic.y,
                            direct.z + indirect.z + caustic.z, direct.w};
        const std::size_t at = first + i;
        storeMean(sum, share, film.rgba.data() + 4 * at);
        film.rgba[4 * at + 3] = sum.w * share;
        storeMean(layers[LAYER_ALBEDO * pixels + i], share, film.albedo.data() + 3 * at);
        film.samples[at] = static_cast<float>(samples);
        // the last sample is not squared yet
        film.variance[at] = varianceOfMean(luminance(sum.x, sum.y, sum.z),
                                           double{caustic.w} + double{indirect.w} * indirect.w, samples);
        if (film.direct.empty()) return;
        storeMean(direct, share, film.direct.data() + 3 * at);
        storeMean(indirect, share, film.indirect.data() + 3 * at);
        storeMean(caustic, share, film.caustic.data() + 3 * at);
    };
    forAll((pixels + kPixelsAtOnce - 1) / kPixelsAtOnce, [&](std::size_t part) {
        const std::size_t end = std::min((part + 1) * kPixelsAtOnce, pixels);
        for (std::size_t i = part * kPixelsAtOnce; i < end; ++i) storePixel(i);
    });
}

void restoreLight(Device& device, FrameBuffers& buffers, Band band, std::uint32_t samples, const Film& film) {
    if (film.direct.empty()) throw std::logic_error("film: there are no parts of the light to go on from");
    const std::size_t pixels = pixelCount(band, film), first = firstPixel(band, film);
    std::vector<gpu::vec4> layers(FILM_LAYERS * pixels);
    const auto sum = static_cast<float>(samples);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::size_t at = first + i;
        const float* rgba = film.rgba.data() + 4 * at;
        const double mean = luminance(rgba[0], rgba[1], rgba[2]);
        const double squares = samples * (double{film.variance[at]} * (samples - 1.0) + mean * mean);
        layers[LAYER_DIRECT * pixels + i] = restored(film.direct.data() + 3 * at, sum, rgba[3] * sum);
        layers[LAYER_INDIRECT * pixels + i] = restored(film.indirect.data() + 3 * at, sum, 0);
        layers[LAYER_CAUSTIC * pixels + i] =
            restored(film.caustic.data() + 3 * at, sum,
                     samples > 1 ? static_cast<float>(squares) : static_cast<float>(mean * mean));
        layers[LAYER_ALBEDO * pixels + i] = restored(film.albedo.data() + 3 * at, sum, 0);
    }
    uploadBuffer(device, buffers.film, layers.data(), layers.size() * sizeof layers[0]);
}

void storeFirstHits(Device& device, const FrameBuffers& buffers, Band band, const DeviceScene& scene,
                    const RenderSettings& settings, const Camera& camera, Film& film) {
    std::vector<gpu::vec4> copy;
    const gpu::vec4* const hits =
        readVectors(device, buffers.first_hits, FIRST_HIT_VECTORS * pixelCount(band, film), copy);
    for (std::uint32_t row = 0; row < band.rows; ++row)
        for (std::uint32_t x = 0; x < film.width; ++x) {
            const gpu::vec4* hit = hits + FIRST_HIT_VECTORS * (std::size_t{row} * film.width + x);
            if (hit->w < 0) continue;
            const std::uint32_t y = band.first_row + row;
            const std::size_t pixel = std::size_t{y} * film.width + x;
            const double distance = hit->w * scene.space.scale;
            const Vec3 at =
                centerRayOrigin(settings, camera, x, y) + distance * centerRayDirection(settings, camera, x, y);
            film.depth[pixel] = static_cast<float>(distance);
            const float normal[] = {hit->x, hit->y, hit->z};
            const double position[] = {at.x, at.y, at.z};
            for (int c = 0; c < 3; ++c) {
                film.normal[3 * pixel + c] = normal[c];
                film.position[3 * pixel + c] = static_cast<float>(position[c]);
            }
            const auto owner = std::bit_cast<std::uint32_t>(hit[1].y);
            film.instance_id[pixel] = owner;
            if (owner != OWNER_SHAPES) film.splat_id[pixel] = std::bit_cast<std::uint32_t>(hit[1].x);
        }
}

} // namespace pointrt
