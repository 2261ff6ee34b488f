// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/moving_picture.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstring>
#include <utility>

#include "format/base/parallel.h"
#include "runtime/image/tonemap.h"
#include "runtime/render/frame_params.h"
#include "runtime/scene/integrator.h"
#include "runtime/window/live/hole_filling.h"

namespace pointrt {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Of a new measurement in an estimate. Slower than before is believed sooner than faster: see pace.cpp.
double learnt(double before, double measured) {
    constexpr double kShareOfSlower = 0.6, kShareOfFaster = 0.3;
    return before + (measured > before ? kShareOfSlower : kShareOfFaster) * (measured - before);
}

/// Fewer are no picture, however slow the tracer is.
constexpr double kFewest = 512;
/// Of a frame's time, what is traced at least, whatever all else takes.
constexpr double kTracedShare = 0.3;
/// Chances may come to this much more pixels than are wanted.
constexpr double kLuck = 1.125;

/// Of a picture, gaps between points of its surfaces that take too long to fill: where points lie as by chance, one a
/// pixel, a sixth of the pixels have none, and a fifth after a zoom by a tenth.
constexpr double kManyGaps = 0.2;

bool sameShapes(const std::vector<gpu::Shape>& a, const std::vector<gpu::Shape>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(gpu::Shape)) == 0;
}

/// The pixels of rows first to end, tile by tile.
std::vector<std::uint32_t> pixelsOfRows(PixelSize size, std::uint32_t first, std::uint32_t end) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t top = first; top < end; top += TILE_SIDE)
        for (std::uint32_t left = 0; left < size.width; left += TILE_SIDE)
            for (std::uint32_t y = top; y < std::min(top + TILE_SIDE, end); ++y)
                for (std::uint32_t x = left; x < std::min(left + TILE_SIDE, size.width); ++x)
                    numbers.push_back(y * size.width + x);
    return numbers;
}

} // namespace

MovingPicture::MovingPicture(Device& device, BandTracer& tracer, Buffer& pixels, PixelSize size)
    : device_(device), tracer_(tracer), pixels_(pixels), picture_(size), errors_(size),
      shapes_(tracer.scene->shape_rows) {}

void MovingPicture::forget() {
    picture_.forget();
    errors_.forget();
    camera_.reset();
    surveyed_rows_ = 0;
}

void MovingPicture::noteSceneChange() {
    const bool shapes = !sameShapes(shapes_, tracer_.scene->shape_rows);
    picture_.noteSceneChange(shapes, frame_);
    if (shapes) camera_.reset(); // what is gone is seen when the picture is carried
    shapes_ = tracer_.scene->shape_rows;
}

void MovingPicture::takePixels() {
    std::vector<std::uint32_t> colors(picture_.keys().size());
    downloadBuffer(device_, pixels_, colors.data(), colors.size() * sizeof(std::uint32_t));
    picture_.takeColors(colors);
}

CarryView MovingPicture::viewOf(const MovingView& view) const {
    return CarryView(makeFrameParams(*tracer_.scene, view.settings, view.camera, 0, picture_.size().height));
}

std::uint32_t MovingPicture::wantedFor(double seconds) const {
    const double pixels = double{1} * picture_.size().width * picture_.size().height;
    const double most = std::min<double>(pixels, kListedPixels) / kLuck;
    const double left = std::max(seconds - overhead_s_, kTracedShare * seconds);
    return static_cast<std::uint32_t>(std::clamp(left / seconds_per_pixel_, std::min(kFewest, most), most));
}

MovingFrame MovingPicture::advance(const MovingView& view, double seconds) {
    const Clock::time_point start = Clock::now();
    ++frame_;
    const CarryView seen = viewOf(view);
    const bool moves = camera_ != view.camera;
    if (moves) picture_.carryTo(seen);
    errors_.pass();
    camera_ = view.camera;
    surveyed_rows_ = 0;
    const PixelSize size = picture_.size();
    const Attention attention{
        {static_cast<float>(view.focus_x * size.width), static_cast<float>(view.focus_y * size.height)},
        frame_,
        moves,
        wantedFor(seconds)};
    std::vector<std::uint32_t> chosen = choosePixels(picture_, errors_, attention);
    chosen.resize(std::min(chosen.size(), static_cast<std::size_t>(kLuck * attention.wanted)));

    const Clock::time_point tracing = Clock::now();
    const std::vector<TracedPixel> traced = trace(view, chosen);
    const double traced_s = since(tracing);
    if (!chosen.empty()) seconds_per_pixel_ = learnt(seconds_per_pixel_, traced_s / static_cast<double>(chosen.size()));

    const Mixing mixing{frame_, hasTrait(view.settings.integrator, INTEGRATOR_BY_CHANCE), moves};
    depositPixels(picture_, errors_, seen, mixing, traced);
    const std::uint32_t gaps = fillHoles(picture_);
    uploadBuffer(device_, pixels_, picture_.shown().data(), picture_.shown().size() * sizeof(std::uint32_t));
    if (gaps > kManyGaps * size.width * size.height) rebuildPoints(picture_, seen);
    overhead_s_ = learnt(overhead_s_, since(start) - traced_s);
    return {static_cast<std::uint32_t>(chosen.size()), picture_.holeCount() - gaps};
}

/// x | y << 16 of each, in rows that are whole.
void MovingPicture::listPlaces(std::span<const std::uint32_t> numbers) {
    const std::uint32_t width = picture_.size().width;
    std::vector<std::uint32_t> places;
    places.reserve(numbers.size());
    for (std::uint32_t number : numbers) places.push_back(number % width | number / width << 16);
    while (places.size() % kPlacesRow != 0) places.push_back(places.back());
    uploadBuffer(device_, tracer_.buffers.places, places.data(), places.size() * sizeof(std::uint32_t));
}

/// What the listed pixels have hit, whose first hits are from first on.
std::vector<TracedPixel> MovingPicture::readHits(std::span<const std::uint32_t> numbers, std::uint32_t first) const {
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

/// The colours of the listed pixels, from the film's first ones.
void MovingPicture::readLight(const MovingView& view, std::span<TracedPixel> traced) const {
    constexpr std::uint32_t kLayers[] = {LAYER_DIRECT, LAYER_INDIRECT, LAYER_CAUSTIC};
    std::vector<gpu::vec4> sums(traced.size()), layer(traced.size());
    for (std::uint32_t which : kLayers) {
        downloadBuffer(device_, tracer_.buffers.film, layer.data(), layer.size() * sizeof(gpu::vec4),
                       std::uint64_t{which} * kListedPixels * sizeof(gpu::vec4));
        for (std::size_t i = 0; i < layer.size(); ++i)
            sums[i] = {sums[i].x + layer[i].x, sums[i].y + layer[i].y, sums[i].z + layer[i].z, 1};
    }
    constexpr std::size_t kChunk = 1024;
    const auto stops = static_cast<float>(view.exposure);
    forAll((traced.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
        const std::size_t first = chunk * kChunk, count = std::min(kChunk, traced.size() - first);
        std::vector<std::uint8_t> rgb(3 * count);
        tonemapPixels({&sums[first].x, 4 * count}, stops, rgb.data());
        for (std::size_t i = 0; i < count; ++i)
            traced[first + i].color = wordOf(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
    });
}

std::vector<TracedPixel> MovingPicture::trace(const MovingView& view, std::span<const std::uint32_t> numbers) {
    if (numbers.empty()) return {};
    listPlaces(numbers);
    RenderSettings settings = view.settings;
    settings.seed += frame_; // other random numbers each time
    const auto count = static_cast<std::uint32_t>(numbers.size());
    BandSample sample = openPlaces(device_, tracer_, settings, view.camera, count, {kListedPixels, 0});
    RayCounts rays;
    while (!sample.done) traceOn(device_, tracer_, sample, std::max(settings.bounces, 1u), rays);
    std::vector<TracedPixel> traced = readHits(numbers, 0);
    readLight(view, traced);
    return traced;
}

bool MovingPicture::survey(const MovingView& view) {
    if (isSurveyed()) return true;
    const PixelSize size = picture_.size();
    if (surveyed_rows_ == 0) survey_ = Survey{{}, std::vector<float>(picture_.keys().size())};
    survey_.points.resize(picture_.keys().size());
    // whole tiles where that many rows fit
    const std::uint32_t fitting = std::max(kListedPixels / size.width / TILE_SIDE * TILE_SIDE, 1u);
    const std::uint32_t end = std::min(surveyed_rows_ + fitting, size.height);
    const std::vector<std::uint32_t> numbers = pixelsOfRows(size, surveyed_rows_, end);
    listPlaces(numbers);
    const std::uint32_t beyond = size.width * size.height; // of the film's own first hits
    const auto count = static_cast<std::uint32_t>(numbers.size());
    BandSample sample = openPlaces(device_, tracer_, view.settings, view.camera, count, {kListedPixels, beyond});
    sample.only_first_hits = true;
    RayCounts rays;
    traceOn(device_, tracer_, sample, 0, rays);
    const CarryView seen = viewOf(view);
    for (const TracedPixel& each : readHits(numbers, beyond)) {
        survey_.points.set(each.number, pointOf(seen, each, frame_));
        survey_.points.info[each.number] |= kCarriedSamplesMost << kCarriedSamplesShift;
        survey_.ahead[each.number] = aheadOf(seen, each);
    }
    surveyed_rows_ = end;
    if (!isSurveyed()) return false;
    picture_.replace(std::move(survey_.points), survey_.ahead);
    survey_ = {};
    camera_ = view.camera;
    return true;
}

void MovingPicture::blendOver(std::uint32_t first, std::uint32_t count, float share) {
    std::vector<std::uint32_t> shown(count);
    downloadBuffer(device_, pixels_, shown.data(), count * sizeof(std::uint32_t), first * sizeof(std::uint32_t));
    const auto parts = static_cast<std::uint32_t>(256 * share + 0.5f);
    for (std::uint32_t i = 0; i < count; ++i) shown[i] = mixed(picture_.shown()[first + i], shown[i], parts);
    uploadBuffer(device_, pixels_, shown.data(), count * sizeof(std::uint32_t), first * sizeof(std::uint32_t));
}

} // namespace pointrt
