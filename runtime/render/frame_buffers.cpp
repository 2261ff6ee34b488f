// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/frame_buffers.h"

#include <utility>

#include "runtime/util/on_error.h"
#include "shaders/shared/params.h"

namespace pointrt {
namespace {

Buffer createFilmBuffer(Device& device, std::uint64_t pixels, std::uint32_t layers) {
    return createBuffer(device, "film buffer", pixels * layers * sizeof(gpu::vec4), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

} // namespace

std::uint32_t tilesOf(std::uint32_t width, std::uint32_t rows) {
    return (width + TILE_SIDE - 1) / TILE_SIDE * ((rows + TILE_SIDE - 1) / TILE_SIDE);
}

std::uint32_t lanesOf(std::uint32_t width, std::uint32_t rows) { return tilesOf(width, rows) * TILE_PIXELS; }

std::uint32_t filmLayers(std::uint32_t samples) { return samples > FILM_BATCH ? 2 * FILM_LAYERS : FILM_LAYERS; }

FrameBuffers createFrameBuffers(Device& device, std::uint32_t lane_count, FilmRoom film, bool culls,
                                GaussianRoom gaussians) {
    const std::uint64_t lanes = lane_count;
    FrameBuffers buffers;
    const auto storage = [&](const char* what, std::uint64_t bytes, VkBufferUsageFlags more = 0) {
        buffers.device_bytes += bytes;
        return createBuffer(device, what, bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | more);
    };
    const auto texels = [&](const char* what, std::uint64_t bytes, VkFormat format, VkBufferUsageFlags usage) {
        Buffer buffer = storage(what, bytes, usage);
        createTexelView(device, what, buffer, format);
        return buffer;
    };
    constexpr VkBufferUsageFlags kRead = VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    const OnError undo([&] { destroyFrameBuffers(device, buffers); });
    buffers.params = storage("frame parameters", sizeof(gpu::FrameParams), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    buffers.control = storage("control buffer", sizeof(gpu::Control), VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
    buffers.lanes = lane_count;
    buffers.control_read = createBuffer(
        device, "control readback", kFramesInFlight * kSamplesAtOnce * sizeof(gpu::Control), 0, MemoryHome::kReadback);
    // words per lane, see shaders/lib/bindings.glsl
    constexpr std::uint64_t kQueueWords = 5 + SHADOW_RAYS_PER_PATH, kCullWords = SHADOW_RAYS_PER_PATH + CULLED_ENTRIES;
    const std::uint64_t queue_words = kQueueWords + (culls ? kCullWords : 0);
    buffers.queues = texels("queue buffer", queue_words * lanes * sizeof(std::uint32_t), VK_FORMAT_R32_UINT, kRead);
    buffers.paths = texels("path buffer", lanes * sizeof(gpu::PathState), VK_FORMAT_R32G32B32A32_UINT, kRead);
    buffers.hits = texels("hit buffer", lanes * sizeof(gpu::uvec4), VK_FORMAT_R32G32B32A32_UINT,
                          VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT);
    const std::uint64_t beams = lanes / TILE_PIXELS * (culls ? CULL_INSTANCES : 1); // pooled tiles have one each
    buffers.beams = texels("beam buffer", beams * sizeof(float), VK_FORMAT_R32_SFLOAT, kRead);
    buffers.pixel_list = texels("pixel list", lanes * sizeof(std::uint32_t), VK_FORMAT_R32_UINT, kRead);
    buffers.surfaces = texels("surface buffer", lanes * sizeof(gpu::StoredSurface), VK_FORMAT_R32G32B32A32_UINT, kRead);
    buffers.light_queries =
        texels("light query buffer", lanes * sizeof(gpu::DirectLightQuery), VK_FORMAT_R32G32B32A32_UINT, kRead);
    buffers.no_cull_boxes = storage("blank cull boxes", sizeof(gpu::CullBoxes), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    buffers.light_masks = storage("light mask buffer", lanes * sizeof(std::uint32_t));
    buffers.deferred = storage("deferred ray buffer", lanes * MAX_DEFERRED * sizeof(gpu::PathState));
    buffers.gaussian_light =
        storage("Gaussian light buffer", (gaussians != GaussianRoom::kNone ? lanes : 1) * sizeof(gpu::GaussianLight));
    buffers.waiting_gaussians = storage("waiting Gaussian buffer", (gaussians == GaussianRoom::kSeveral ? lanes : 1) *
                                                                       sizeof(gpu::WaitingGaussians));
    createFilm(device, buffers, film);
    return buffers;
}

void createFilm(Device& device, FrameBuffers& buffers, FilmRoom film) {
    buffers.device_bytes -= buffers.film.bytes + buffers.first_hits.bytes;
    destroyBuffer(device, buffers.film);
    destroyBuffer(device, buffers.first_hits);
    buffers.film_pixels = film.pixels;
    buffers.film_layers = filmLayers(film.samples);
    buffers.film = createFilmBuffer(device, film.pixels, buffers.film_layers);
    buffers.device_bytes += buffers.film.bytes;
    buffers.first_hits = createBuffer(device, "first hit buffer", film.pixels * FIRST_HIT_VECTORS * sizeof(gpu::vec4),
                                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    buffers.device_bytes += buffers.first_hits.bytes;
}

bool extendFilm(Device& device, FrameBuffers& buffers, std::uint32_t samples) {
    const std::uint32_t layers = filmLayers(samples);
    if (layers <= buffers.film_layers) return false;
    Buffer film = createFilmBuffer(device, buffers.film_pixels, layers);
    const OnError undo([&] { destroyBuffer(device, film); });
    copyBuffer(device, buffers.film, film, buffers.film.bytes); // layers that are new come last in the buffer
    buffers.device_bytes += film.bytes - buffers.film.bytes;
    std::swap(buffers.film, film);
    destroyBuffer(device, film);
    buffers.film_layers = layers;
    return true;
}

void destroyFrameBuffers(Device& device, FrameBuffers& buffers) {
    for (Buffer* buffer :
         {&buffers.params, &buffers.control, &buffers.queues, &buffers.paths, &buffers.hits, &buffers.surfaces,
          &buffers.light_queries, &buffers.light_masks, &buffers.deferred, &buffers.film, &buffers.first_hits,
          &buffers.beams, &buffers.pixel_list, &buffers.gaussian_light, &buffers.waiting_gaussians,
          &buffers.no_cull_boxes, &buffers.control_read})
        destroyBuffer(device, *buffer);
    buffers = {};
}

std::vector<BufferBinding> frameBindings(const FrameBuffers& buffers) {
    return {{BINDING_PARAMS, &buffers.params},
            {BINDING_CONTROL, &buffers.control},
            {BINDING_QUEUES, &buffers.queues},
            {BINDING_QUEUES_TEXELS, &buffers.queues},
            {BINDING_PATHS, &buffers.paths},
            {BINDING_PATHS_TEXELS, &buffers.paths},
            {BINDING_HITS, &buffers.hits},
            {BINDING_LIGHT_QUERIES, &buffers.light_queries},
            {BINDING_LIGHT_QUERIES_TEXELS, &buffers.light_queries},
            {BINDING_FILM, &buffers.film},
            {BINDING_FIRST_HITS, &buffers.first_hits},
            {BINDING_BEAMS, &buffers.beams},
            {BINDING_BEAMS_TEXELS, &buffers.beams},
            {BINDING_SURFACES, &buffers.surfaces},
            {BINDING_SURFACES_TEXELS, &buffers.surfaces},
            {BINDING_LIGHT_MASKS, &buffers.light_masks},
            {BINDING_DEFERRED, &buffers.deferred},
            {BINDING_PIXEL_LIST, &buffers.pixel_list},
            {BINDING_GAUSSIAN_LIGHT, &buffers.gaussian_light},
            {BINDING_WAITING_GAUSSIANS, &buffers.waiting_gaussians},
            {BINDING_SHADOW_RAYS, &buffers.light_queries},
            {BINDING_SHADOW_RAYS_TEXELS, &buffers.light_queries}};
}

} // namespace pointrt
