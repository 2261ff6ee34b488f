// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/film_readout.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "format/base/parallel.h"
#include "runtime/image/film_parts.h"
#include "runtime/render/frame_params.h"
#include "shaders/shared/luminance.h"
#include "shaders/shared/luminance_moments.h"

namespace pointrt {

namespace {

constexpr std::size_t kPixelsAtOnce =
    1 << 16; ///< per thread: a millisecond of work; starting a thread takes a tenth of that

std::size_t firstPixel(Band band, const Film& film) { return std::size_t{band.first_row} * film.width; }
std::size_t pixelCount(Band band, const Film& film) { return std::size_t{band.rows} * film.width; }

/// The vectors of buffer in host-readable memory: the mapped memory itself, else a copy in `copy`.
const gpu::vec4* readVectors(Device& device, const Buffer& buffer, std::size_t count, std::vector<gpu::vec4>& copy) {
    if (buffer.mapped) waitForSubmitted(device);
    if (buffer.mapped) return reinterpret_cast<const gpu::vec4*>(hostBytes(device, buffer));
    copy.resize(count);
    downloadBuffer(device, buffer, copy.data(), count * sizeof copy[0]);
    return copy.data();
}

static_assert(kMaxSpp <= FILM_BATCH * FILM_BATCH, "a sum of more batches keeps too few bits of each");

bool hasEarlierBatches(std::uint32_t samples) { return samples > FILM_BATCH; }

gpu::vec4 sumOf(const gpu::vec4& a, const gpu::vec4& b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }

/// The film of a pixel on the device: sums over samples, of all batches.
struct PixelLight {
    gpu::vec4 layers[FILM_LAYERS];
    gpu::vec4 sum; ///< total light; w: coverage
    std::uint32_t samples;
    float share; ///< 1 / samples
};

/// The first hit of a pixel's centre ray.
struct PixelHit {
    gpu::vec4 surface;                  ///< normal and t
    std::array<std::uint32_t, 4> words; ///< HIT_*
    double distance;                    ///< input units
    Vec3 position;
};

void storeMean(const gpu::vec4& sum, float share, float* rgb) {
    rgb[0] = sum.x * share;
    rgb[1] = sum.y * share;
    rgb[2] = sum.z * share;
}

gpu::vec4 restored(const float* rgb, float sum) { return {rgb[0] * sum, rgb[1] * sum, rgb[2] * sum, 0}; }

// The sources named in FILM_PARTS: each stores its values from a pixel's light or from its first hit.

struct Beauty {
    static void store(const PixelLight& pixel, float* rgba) {
        storeMean(pixel.sum, pixel.share, rgba);
        rgba[3] = pixel.sum.w * pixel.share;
    }
};

/// The mean of a film layer; can be restored to a sum.
template <std::uint32_t kLayer>
struct Mean {
    static constexpr std::uint32_t layer = kLayer;
    static void store(const PixelLight& pixel, float* rgb) { storeMean(pixel.layers[kLayer], pixel.share, rgb); }
};

struct Samples {
    static void store(const PixelLight& pixel, float* count) { *count = static_cast<float>(pixel.samples); }
};

struct Variance {
    static void store(const PixelLight& pixel, float* variance) {
        const auto samples = static_cast<float>(pixel.samples);
        // the moments do not include the last sample
        const LuminanceMoments moments = addLuminance({pixel.layers[LAYER_ALBEDO].w, pixel.layers[LAYER_CAUSTIC].w},
                                                      pixel.layers[LAYER_INDIRECT].w, samples);
        *variance = samples < 2 ? std::numeric_limits<float>::infinity() : varianceOfMean(moments, samples);
    }
};

struct Depth {
    static void store(const PixelHit& pixel, float* depth) { *depth = static_cast<float>(pixel.distance); }
};

struct Normal {
    static void store(const PixelHit& pixel, float* normal) {
        normal[0] = pixel.surface.x;
        normal[1] = pixel.surface.y;
        normal[2] = pixel.surface.z;
    }
};

struct Position {
    static void store(const PixelHit& pixel, float* position) {
        position[0] = static_cast<float>(pixel.position.x);
        position[1] = static_cast<float>(pixel.position.y);
        position[2] = static_cast<float>(pixel.position.z);
    }
};

/// A word of a first hit.
template <std::uint32_t kWord>
struct HitWord {
    static void store(const PixelHit& pixel, std::uint32_t* word) { *word = pixel.words[kWord]; }
};

std::uint32_t ownerOf(const PixelHit& pixel) { return pixel.words[HIT_OWNER] & HIT_OWNER_MASK; }

struct OwnerId {
    static void store(const PixelHit& pixel, std::uint32_t* id) { *id = ownerOf(pixel); }
};

struct TileId {
    static void store(const PixelHit& pixel, std::uint32_t* id) {
        const std::uint32_t tile = pixel.words[HIT_OWNER] >> HIT_TILE_SHIFT;
        if (tile > 0) *id = tile - 1;
    }
};

struct SplatId {
    static void store(const PixelHit& pixel, std::uint32_t* id) {
        if (ownerOf(pixel) != OWNER_SHAPES) *id = pixel.words[HIT_SPLAT];
    }
};

template <typename Source, typename Value>
concept StoresLight = requires(const PixelLight& pixel, Value* values) {
    Source::store(pixel, values);
};
template <typename Source, typename Value>
concept StoresHit = requires(const PixelHit& pixel, Value* values) {
    Source::store(pixel, values);
};

/// Stores a pixel's values in an array, if the film has the array and its source uses this kind of pixel.
template <typename Source, std::size_t kValues, typename Pixel, typename Value>
void storeValues(const Pixel& pixel, std::size_t at, std::vector<Value>& values) {
    static_assert(StoresLight<Source, Value> != StoresHit<Source, Value>, "a source stores one or the other");
    if constexpr (requires { Source::store(pixel, values.data()); })
        if (!values.empty()) Source::store(pixel, values.data() + kValues * at);
}

template <typename Pixel>
void storePixel(const Pixel& pixel, std::size_t at, Film& film) {
#define POINTRT_STORE(array, Value, channels, group, nothing, source, view)                                            \
    storeValues<source, film_values::array>(pixel, at, film.array);
    FILM_PARTS(POINTRT_STORE)
#undef POINTRT_STORE
}

/// Restores the sums of a layer, if the source is a mean.
template <typename Source>
void restoreValues(std::size_t at, const std::vector<float>& values, float samples, PixelLight& pixel) {
    if constexpr (requires { Source::layer; }) pixel.layers[Source::layer] = restored(values.data() + 3 * at, samples);
}
template <typename Source>
void restoreValues(std::size_t, const std::vector<std::uint32_t>&, float, PixelLight&) {}

/// The film sums of a pixel over that many samples.
PixelLight restoredPixel(const Film& film, std::size_t at, std::uint32_t samples) {
    PixelLight pixel{};
    const auto sum = static_cast<float>(samples);
#define POINTRT_RESTORE(array, Value, channels, group, nothing, source, view)                                          \
    restoreValues<source>(at, film.array, sum, pixel);
    FILM_PARTS(POINTRT_RESTORE)
#undef POINTRT_RESTORE
    const float* rgba = film.rgba.data() + 4 * at;
    pixel.layers[LAYER_DIRECT].w = rgba[3] * sum;
    pixel.layers[LAYER_INDIRECT].w = pixel.layers[LAYER_ALBEDO].w = luminance(rgba[0], rgba[1], rgba[2]);
    pixel.layers[LAYER_CAUSTIC].w = samples > 1 ? film.variance[at] * sum * (sum - 1) : 0;
    return pixel;
}

/// Moves the sums of a layer to the earlier batches, as shaders/shade/fold_film.comp.glsl does.
void foldLayer(std::uint32_t layer, gpu::vec4& batch, gpu::vec4& earlier) {
    earlier = std::exchange(batch, {});
    if (layer == LAYER_INDIRECT || layer == LAYER_ALBEDO) std::swap(batch.w, earlier.w);
}

bool has(FilmGroup group, const RenderSettings& settings) {
    if (group == FilmGroup::kLightParts) return settings.light_parts;
    if (group == FilmGroup::kFirstHits) return settings.first_hits;
    return true;
}

} // namespace

void allocateFilm(const RenderSettings& settings, Film& film) {
    const std::size_t pixels = std::size_t{settings.width} * settings.height;
    film.width = settings.width;
    film.height = settings.height;
#define POINTRT_ALLOCATE(array, Value, channels, group, nothing, source, view)                                         \
    film.array.assign(has(FilmGroup::group, settings) ? film_values::array* pixels : 0, static_cast<Value>(nothing));
    FILM_PARTS(POINTRT_ALLOCATE)
#undef POINTRT_ALLOCATE
}

std::uint64_t filmBytesPerPixel(const RenderSettings& settings) {
    std::uint64_t bytes = 0;
#define POINTRT_BYTES(array, Value, channels, group, nothing, source, view)                                            \
    if (has(FilmGroup::group, settings)) bytes += film_values::array * sizeof(Value);
    FILM_PARTS(POINTRT_BYTES)
#undef POINTRT_BYTES
    return bytes;
}

void storeLight(Device& device, const FrameBuffers& buffers, const BandRows& rows, std::uint32_t samples, Film& film) {
    const std::size_t width = film.width, stride = width * rows.band.rows, pixels = width * rows.rows;
    const std::size_t from = width * rows.first, to = width * (rows.band.first_row + rows.first - rows.film_origin);
    std::vector<gpu::vec4> copy;
    const gpu::vec4* const layers = readVectors(device, buffers.film, filmLayers(samples) * stride, copy) + from;
    const auto store = [&](std::size_t i) {
        PixelLight pixel{{}, {}, samples, 1.0f / static_cast<float>(samples)};
        for (std::uint32_t layer = 0; layer < FILM_LAYERS; ++layer) {
            const gpu::vec4* batch = layers + layer * stride + i;
            pixel.layers[layer] = hasEarlierBatches(samples) ? sumOf(*batch, batch[FILM_LAYERS * stride]) : *batch;
        }
        const gpu::vec4 &direct = pixel.layers[LAYER_DIRECT], &indirect = pixel.layers[LAYER_INDIRECT],
                        &caustic = pixel.layers[LAYER_CAUSTIC];
        pixel.sum = {direct.x + indirect.x + caustic.x, direct.y + indirect.y + caustic.y,
                     direct.z + indirect.z + caustic.z, direct.w};
        storePixel(pixel, to + i, film);
    };
    forAll((pixels + kPixelsAtOnce - 1) / kPixelsAtOnce, [&](std::size_t part) {
        const std::size_t end = std::min((part + 1) * kPixelsAtOnce, pixels);
        for (std::size_t i = part * kPixelsAtOnce; i < end; ++i) store(i);
    });
}

void restoreLight(Device& device, FrameBuffers& buffers, Band band, std::uint32_t samples, const Film& film) {
    if (film.direct.empty()) throw std::logic_error("film: lacks the light parts needed to resume");
    const std::size_t pixels = pixelCount(band, film), first = firstPixel(band, film);
    std::vector<gpu::vec4> layers(filmLayers(samples) * pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const PixelLight pixel = restoredPixel(film, first + i, samples);
        for (std::uint32_t layer = 0; layer < FILM_LAYERS; ++layer) {
            gpu::vec4& batch = layers[layer * pixels + i] = pixel.layers[layer];
            if (hasEarlierBatches(samples)) foldLayer(layer, batch, (&batch)[FILM_LAYERS * pixels]);
        }
    }
    uploadBuffer(device, buffers.film, layers.data(), layers.size() * sizeof layers[0]);
}

void storeFirstHits(Device& device, const FrameBuffers& buffers, const BandRows& rows, const DeviceScene& scene,
                    const RenderSettings& settings, const Camera& camera, Film& film) {
    std::vector<gpu::vec4> copy;
    const gpu::vec4* const hits =
        readVectors(device, buffers.first_hits, FIRST_HIT_VECTORS * pixelCount(rows.band, film), copy);
    for (std::uint32_t row = rows.first; row < rows.first + rows.rows; ++row)
        for (std::uint32_t x = 0; x < film.width; ++x) {
            const gpu::vec4* hit = hits + FIRST_HIT_VECTORS * (std::size_t{row} * film.width + x);
            if (hit->w < 0) continue;
            const std::uint32_t y = rows.band.first_row + row;
            PixelHit pixel{hit[0], std::bit_cast<std::array<std::uint32_t, 4>>(hit[1]), hit->w * scene.space.scale, {}};
            pixel.position =
                centerRayOrigin(settings, camera, x, y) + pixel.distance * centerRayDirection(settings, camera, x, y);
            storePixel(pixel, std::size_t{y - rows.film_origin} * film.width + x, film);
        }
}

} // namespace pointrt
