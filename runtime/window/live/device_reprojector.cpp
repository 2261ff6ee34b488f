// SPDX-License-Identifier: Apache-2.0
#include "runtime/window/live/device_reprojector.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/render/frame_params.h"
#include "runtime/scene/integrator.h"
#include "runtime/util/clock.h"
#include "runtime/window/live/pixel_list.h"
#include "shaders/shared/display_layout.h"

namespace pointrt {

DeviceReprojector::DeviceReprojector(Device& device, BandTracer& tracer, Buffer& pixels, PixelSize size)
    : device_(device), tracer_(tracer), pixels_(pixels),
      cache_(createDeviceCache(device, size, tracer.buffers, pixels)), shapes_(tracer.scene->shape_rows) {
    clear();
}

DeviceReprojector::~DeviceReprojector() {
    finishSubmitted(device_);
    destroyDeviceCache(device_, cache_);
}

void DeviceReprojector::bindFilm() { bindDeviceCache(device_, cache_, tracer_.buffers, pixels_); }

/// Records commands that go with the next submission.
void DeviceReprojector::record(const char* name, const std::function<void(VkCommandBuffer)>& commands) {
    const VkCommandBuffer recorded = beginCommands(device_, name);
    {
        const CommandLabel label(device_, recorded, name);
        commands(recorded);
    }
    submitWithNext(device_, recorded);
}

void DeviceReprojector::clear() {
    gpu::ReprojectionParams size{};
    size.width = cache_.size.width;
    size.height = cache_.size.height;
    size.points = pointsOf(cache_.size);
    size.tiles_across = (size.width + TILE_SIDE - 1) / TILE_SIDE;
    size.tiles_down = (size.height + TILE_SIDE - 1) / TILE_SIDE;
    record("cache cleared", [&](VkCommandBuffer commands) {
        recordParams(commands, cache_, size);
        recordClear(commands, cache_);
    });
    camera_.reset();
    filled_rows_ = 0;
}

void DeviceReprojector::invalidateLighting() {
    const bool shapes = !sameShapes(shapes_, tracer_.scene->shape_rows);
    record("cache outdated", [&](VkCommandBuffer commands) { recordOutdate(commands, cache_, frame_, shapes); });
    if (shapes) camera_.reset(); // removed points leave empty pixels after the next reprojection
    shapes_ = tracer_.scene->shape_rows;
}

void DeviceReprojector::readBackColors() {
    record("colours to the cache", [&](VkCommandBuffer commands) { recordTakeColors(commands, cache_); });
}

gpu::ReprojectionParams DeviceReprojector::paramsFor(const ReprojectionView& view) const {
    const gpu::FrameParams frame = makeFrameParams(*tracer_.scene, view.settings, view.camera, 0, cache_.size.height);
    gpu::ReprojectionParams params{};
    params.eye = frame.eye;
    params.tan_half_fov = frame.tan_half_fov;
    params.right = frame.right;
    params.aspect = frame.aspect;
    params.up = frame.up;
    params.half_window = frame.half_window;
    params.forward = frame.forward;
    params.frame = frame_;
    params.width = cache_.size.width;
    params.height = cache_.size.height;
    params.tiles_across = (params.width + TILE_SIDE - 1) / TILE_SIDE;
    params.tiles_down = (params.height + TILE_SIDE - 1) / TILE_SIDE;
    params.focus_x = static_cast<float>(view.focus_x * params.width);
    params.focus_y = static_cast<float>(view.focus_y * params.height);
    params.points = pointsOf(cache_.size);
    params.most_gaps = static_cast<std::uint32_t>(kMaxGapShare * params.width * params.height);
    params.camera_moves = camera_ != view.camera;
    params.is_noisy = hasTrait(view.settings.integrator, INTEGRATOR_IS_STOCHASTIC);
    params.gain = std::exp2(static_cast<float>(view.exposure));
    params.display = view.compresses_highlights ? DISPLAY_COMPRESSED : DISPLAY_CLIPPED;
    params.film_stride = kMaxListedPixels;
    return params;
}

ReprojectedFrame DeviceReprojector::renderFrame(const ReprojectionView& view, double seconds) {
    while (in_flight_.size() >= kFramesInFlight) finishOldest();
    ++frame_;
    gpu::ReprojectionParams params = paramsFor(view);
    params.selected = pixelBudget(cache_.size, seconds, cost_);
    // traces whole rows of the list; the rest of the last row has pixels of earlier frames
    params.listed = static_cast<std::uint32_t>(kCountMargin * params.selected) / kPixelListWidth * kPixelListWidth;
    FrameInFlight frame;
    frame.place = frame_ % kFramesInFlight;
    frame.traced = params.listed;
    record("reprojection", [&](VkCommandBuffer commands) {
        recordTimerStart(commands, cache_.timer, 2 * frame.place);
        recordParams(commands, cache_, params);
        if (params.camera_moves != 0) recordReproject(commands, cache_);
        recordSelect(commands, cache_);
        recordTimerEnd(commands, cache_.timer, 2 * frame.place);
    });
    camera_ = view.camera;
    filled_rows_ = 0;
    traceListed(view, frame);
    in_flight_.push_back(frame);
    return {frame.traced, disocclusions_};
}

/// Traces the listed pixels, and completes the picture.
void DeviceReprojector::traceListed(const ReprojectionView& view, FrameInFlight& frame) {
    RenderSettings settings = view.settings;
    settings.seed += frame_; // new random numbers in each frame
    BandSample sample = openPixelList(tracer_, settings, view.camera, frame.traced, {kMaxListedPixels, 0});
    const std::uint32_t passes = std::max(settings.bounces, 1u);
    const auto complete = [&](VkCommandBuffer commands) { recordTraced(commands, frame); };
    if (endsIn(tracer_, settings, passes)) {
        frame.passes = submitPasses(device_, tracer_, sample, passes, complete, Submission::kWithNext);
        frame.submission = frame.passes->submission;
        return;
    }
    finish();
    const Clock::time_point start = Clock::now();
    RayCounts rays;
    while (!sample.done) tracePasses(device_, tracer_, sample, passes, rays);
    frame.traced_s = millisecondsSince(start) / 1e3;
    const VkCommandBuffer commands = beginCommands(device_, "reprojection completed");
    complete(commands);
    frame.submission = submitWithNext(device_, commands);
}

void DeviceReprojector::recordTraced(VkCommandBuffer commands, const FrameInFlight& frame) const {
    recordTimerStart(commands, cache_.timer, 2 * frame.place + 1);
    recordInsert(commands, cache_, frame.traced, pixels_);
    recordTimerEnd(commands, cache_.timer, 2 * frame.place + 1);
    const VkBufferCopy counters{0, frame.place * sizeof(gpu::ReprojectionControl), sizeof(gpu::ReprojectionControl)};
    vkCmdCopyBuffer(commands, cache_.control.handle, cache_.control_read.handle, 1, &counters);
}

/// Waits for the oldest frame, and uses its measurements.
void DeviceReprojector::finishOldest() {
    const FrameInFlight frame = in_flight_.front();
    in_flight_.pop_front();
    waitFor(device_, frame.submission);
    RayCounts rays;
    const double traced_s = frame.passes ? finishPasses(device_, tracer_, *frame.passes, rays) : frame.traced_s;
    cost_.seconds_per_pixel = smoothed(cost_.seconds_per_pixel, traced_s / frame.traced);
    const auto spent_s = [&](std::uint32_t range) {
        return elapsedMilliseconds(device_, cache_.timer, range).value_or(0) / 1e3;
    };
    cost_.other_s = smoothed(cost_.other_s, spent_s(2 * frame.place) + spent_s(2 * frame.place + 1));
    const auto* counters =
        reinterpret_cast<const gpu::ReprojectionControl*>(hostBytes(device_, cache_.control_read)) + frame.place;
    disocclusions_ = counters->empty - std::min(counters->gaps, counters->empty);
}

void DeviceReprojector::finish() {
    while (!in_flight_.empty()) finishOldest();
}

bool DeviceReprojector::fillCache(const ReprojectionView& view) {
    if (isFilled()) return true;
    const RowRange rows = listableRows(cache_.size, filled_rows_);
    const std::vector<std::uint32_t> numbers = pixelsOfRows(cache_.size, rows);
    uploadPixelList(device_, tracer_, cache_.size, numbers);
    const auto count = static_cast<std::uint32_t>(numbers.size());
    traceFirstHits(device_, tracer_, view, count, [&](VkCommandBuffer commands) {
        recordParams(commands, cache_, paramsFor(view));
        recordHoldHits(commands, cache_, cache_.size.width * cache_.size.height, count);
        if (rows.end == cache_.size.height) recordReplace(commands, cache_);
    });
    filled_rows_ = rows.end;
    if (!isFilled()) return false;
    camera_ = view.camera;
    return true;
}

void DeviceReprojector::blendWithReprojection(std::uint32_t first, std::uint32_t count, float share) {
    record("blend", [&](VkCommandBuffer commands) { recordBlend(commands, cache_, first, count, share); });
}

} // namespace pointrt
