// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/reprojection_renderer.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "format/base/parallel.h"
#include "runtime/image/tonemap.h"
#include "runtime/render/frame_params.h"
#include "runtime/scene/integrator.h"
#include "runtime/util/clock.h"
#include "runtime/window/live/hole_filling.h"
#include "runtime/window/live/pixel_list.h"
#include "runtime/window/live/trace_speed.h"

namespace pointrt {

ReprojectionRenderer::ReprojectionRenderer(Device& device, BandTracer& tracer, Buffer& pixels, PixelSize size)
    : device_(device), tracer_(tracer), pixels_(pixels), cache_(size), errors_(size),
      shapes_(tracer.scene->shape_rows) {}

void ReprojectionRenderer::clear() {
    cache_.clear();
    errors_.clear();
    camera_.reset();
    filled_rows_ = 0;
}

void ReprojectionRenderer::invalidateLighting() {
    const bool shapes = !sameShapes(shapes_, tracer_.scene->shape_rows);
    cache_.invalidateLighting(shapes, frame_);
    if (shapes) camera_.reset(); // removed points leave empty pixels after the next reprojection
    shapes_ = tracer_.scene->shape_rows;
}

void ReprojectionRenderer::readBackColors() {
    std::vector<std::uint32_t> colors(cache_.keys().size());
    downloadBuffer(device_, pixels_, colors.data(), colors.size() * sizeof(std::uint32_t));
    cache_.setVisibleColors(colors);
}

ViewProjection ReprojectionRenderer::projectionFor(const ReprojectionView& view) const {
    return ViewProjection(makeFrameParams(*tracer_.scene, view.settings, view.camera, 0, cache_.size().height));
}

ReprojectedFrame ReprojectionRenderer::renderFrame(const ReprojectionView& view, double seconds) {
    const Clock::time_point start = Clock::now();
    ++frame_;
    const ViewProjection seen = projectionFor(view);
    const bool camera_moves = camera_ != view.camera;
    if (camera_moves) cache_.reproject(seen);
    errors_.advanceFrame();
    camera_ = view.camera;
    filled_rows_ = 0;
    const PixelSize size = cache_.size();
    const SelectionParams params{
        {static_cast<float>(view.focus_x * size.width), static_cast<float>(view.focus_y * size.height)},
        frame_,
        camera_moves,
        pixelBudget(size, seconds, cost_)};
    std::vector<std::uint32_t> chosen = selectPixels(cache_, errors_, params);
    chosen.resize(std::min(chosen.size(), static_cast<std::size_t>(kCountMargin * params.count)));

    const Clock::time_point tracing = Clock::now();
    const std::vector<TracedPixel> traced = trace(view, chosen);
    const double traced_s = millisecondsSince(tracing) / 1e3;
    if (!chosen.empty())
        cost_.seconds_per_pixel = smoothed(cost_.seconds_per_pixel, traced_s / static_cast<double>(chosen.size()));

    const SampleBlending blending{frame_, hasTrait(view.settings.integrator, INTEGRATOR_IS_STOCHASTIC), camera_moves};
    insertSamples(cache_, errors_, seen, blending, traced);
    const std::uint32_t gaps = fillHoles(cache_);
    uploadBuffer(device_, pixels_, cache_.colors().data(), cache_.colors().size() * sizeof(std::uint32_t));
    if (gaps > kMaxGapShare * size.width * size.height) resamplePoints(cache_, seen);
    cost_.other_s = smoothed(cost_.other_s, millisecondsSince(start) / 1e3 - traced_s);
    return {static_cast<std::uint32_t>(chosen.size()), cache_.emptyPixelCount() - gaps};
}

/// Reads the first hits of the listed pixels, stored from index first on.
std::vector<TracedPixel> ReprojectionRenderer::readHits(std::span<const std::uint32_t> numbers,
                                                        std::uint32_t first) const {
    std::vector<gpu::vec4> hits(numbers.size() * FIRST_HIT_VECTORS);
    downloadBuffer(device_, tracer_.buffers.first_hits, hits.data(), hits.size() * sizeof(gpu::vec4),
                   std::uint64_t{first} * FIRST_HIT_VECTORS * sizeof(gpu::vec4));
    std::vector<TracedPixel> traced(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const gpu::vec4 &hit = hits[FIRST_HIT_VECTORS * i], &ids = hits[FIRST_HIT_VECTORS * i + 1];
        const bool on_shape = hit.w >= 0 && std::bit_cast<std::uint32_t>(ids.y) == OWNER_SHAPES;
        traced[i] = {numbers[i], 0, hit.w, ids.w, on_shape};
    }
    return traced;
}

/// Reads the colours of the listed pixels, stored at the start of the film.
void ReprojectionRenderer::readLight(const ReprojectionView& view, std::span<TracedPixel> traced) const {
    constexpr std::uint32_t kLayers[] = {LAYER_DIRECT, LAYER_INDIRECT, LAYER_CAUSTIC};
    std::vector<gpu::vec4> sums(traced.size()), layer(traced.size());
    for (std::uint32_t which : kLayers) {
        downloadBuffer(device_, tracer_.buffers.film, layer.data(), layer.size() * sizeof(gpu::vec4),
                       std::uint64_t{which} * kMaxListedPixels * sizeof(gpu::vec4));
        for (std::size_t i = 0; i < layer.size(); ++i)
            sums[i] = {sums[i].x + layer[i].x, sums[i].y + layer[i].y, sums[i].z + layer[i].z, 1};
    }
    constexpr std::size_t kChunk = 1024;
    const ToneMapping tone{static_cast<float>(view.exposure), view.compresses_highlights};
    forAll((traced.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t first = chunk * kChunk, count = std::min(kChunk, traced.size() - first);
        std::vector<std::uint8_t> rgb(3 * count);
        tonemapPixels({&sums[first].x, 4 * count}, tone, rgb.data());
        for (std::size_t i = 0; i < count; ++i)
            traced[first + i].color = packColor(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
    });
}

std::vector<TracedPixel> ReprojectionRenderer::trace(const ReprojectionView& view,
                                                     std::span<const std::uint32_t> numbers) {
    if (numbers.empty()) return {};
    uploadPixelList(device_, tracer_, cache_.size(), numbers);
    RenderSettings settings = view.settings;
    settings.seed += frame_; // new random numbers in each frame
    const auto count = static_cast<std::uint32_t>(numbers.size());
    BandSample sample = openPixelList(tracer_, settings, view.camera, count, {kMaxListedPixels, 0});
    RayCounts rays;
    while (!sample.done) tracePasses(device_, tracer_, sample, std::max(settings.bounces, 1u), rays);
    std::vector<TracedPixel> traced = readHits(numbers, 0);
    readLight(view, traced);
    return traced;
}

bool ReprojectionRenderer::fillCache(const ReprojectionView& view) {
    if (isFilled()) return true;
    const PixelSize size = cache_.size();
    if (filled_rows_ == 0) pending_fill_ = CacheFill{{}, std::vector<float>(cache_.keys().size())};
    pending_fill_.points.resize(cache_.keys().size());
    const RowRange rows = listableRows(size, filled_rows_);
    const std::vector<std::uint32_t> numbers = pixelsOfRows(size, rows);
    uploadPixelList(device_, tracer_, size, numbers);
    traceFirstHits(device_, tracer_, view, static_cast<std::uint32_t>(numbers.size()));
    const ViewProjection seen = projectionFor(view);
    for (const TracedPixel& each : readHits(numbers, size.width * size.height)) {
        pending_fill_.points.set(each.pixel, toCachedPoint(seen, each, frame_));
        pending_fill_.points.info[each.pixel] |= kPointMaxSamples << kPointSamplesShift;
        pending_fill_.depth[each.pixel] = depthAlongView(seen, each);
    }
    filled_rows_ = rows.end;
    if (!isFilled()) return false;
    cache_.replace(std::move(pending_fill_.points), pending_fill_.depth);
    pending_fill_ = {};
    camera_ = view.camera;
    return true;
}

void ReprojectionRenderer::blendWithReprojection(std::uint32_t first, std::uint32_t count, float share) {
    std::vector<std::uint32_t> colors(count);
    downloadBuffer(device_, pixels_, colors.data(), count * sizeof(std::uint32_t), first * sizeof(std::uint32_t));
    const auto parts = static_cast<std::uint32_t>(256 * share + 0.5f);
    for (std::uint32_t i = 0; i < count; ++i) colors[i] = mixColors(cache_.colors()[first + i], colors[i], parts);
    uploadBuffer(device_, pixels_, colors.data(), count * sizeof(std::uint32_t), first * sizeof(std::uint32_t));
}

} // namespace pointrt
