// SPDX-License-Identifier: Apache-2.0
// Reprojection in scenes with known pictures: a card in front of a wall.
#include "runtime/window/live/render_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "runtime/window/live/cache_update.h"
#include "runtime/window/live/hole_filling.h"
#include "runtime/window/live/sample_priority.h"

namespace pointrt {
namespace {

constexpr PixelSize kSize{160, 96};
constexpr float kWallAhead = 4, kCardAhead = 2, kTan = 0.5f;

/// A view along -z from (x, 0, 0).
ViewProjection viewFrom(float x) {
    gpu::FrameParams frame{};
    frame.eye = {x, 0, 0};
    frame.right = {1, 0, 0};
    frame.up = {0, 1, 0};
    frame.forward = {0, 0, -1};
    frame.tan_half_fov = kTan;
    frame.aspect = float(kSize.width) / kSize.height;
    frame.picture_width = kSize.width;
    frame.picture_height = kSize.height;
    return ViewProjection(frame);
}

float pixelsPerUnit(float depth) { return kSize.height / (2 * kTan * depth); }

/// The card is the square [-0.5, 0.5] in x and y.
bool seesCard(const ViewProjection& view, std::uint32_t pixel) {
    const gpu::vec3 origin = view.origin(0, 0), direction = view.direction(pixel % kSize.width, pixel / kSize.width);
    return std::abs(origin.x + kCardAhead * direction.x) < 0.5f && std::abs(kCardAhead * direction.y) < 0.5f;
}

constexpr std::uint32_t kCard = 0xFFC08040, kWall = 0xFF204060;

TracedPixel traced(const ViewProjection& view, std::uint32_t pixel) {
    const gpu::vec3 direction = view.direction(pixel % kSize.width, pixel / kSize.width);
    const float length = std::sqrt(direction.x * direction.x + direction.y * direction.y + direction.z * direction.z);
    const bool card = seesCard(view, pixel);
    return {pixel, card ? kCard : kWall, (card ? kCardAhead : kWallAhead) * length, 0, !card};
}

std::vector<TracedPixel> tracedAll(const ViewProjection& view) {
    std::vector<TracedPixel> all;
    for (std::uint32_t pixel = 0; pixel < kSize.width * kSize.height; ++pixel) all.push_back(traced(view, pixel));
    return all;
}

/// The view from x = 0, traced in frame 0.
RenderCache pictureFromZero(ErrorMap& errors) {
    RenderCache cache(kSize);
    const ViewProjection view = viewFrom(0);
    insertSamples(cache, errors, view, {}, tracedAll(view));
    return cache;
}

TEST(ViewProjection, ProjectsPixelCentresToThemselves) {
    const ViewProjection view = viewFrom(0.3f);
    for (std::uint32_t y : {0u, 17u, 95u})
        for (std::uint32_t x : {0u, 80u, 159u}) {
            const gpu::vec3 origin = view.origin(x, y), direction = view.direction(x, y);
            const ViewProjection::Projected seen =
                view.project({origin.x + 3 * direction.x, origin.y + 3 * direction.y, origin.z + 3 * direction.z}, 1);
            EXPECT_NEAR(seen.x, float(x) + 0.5f, 1e-3);
            EXPECT_NEAR(seen.y, float(y) + 0.5f, 1e-3);
            EXPECT_NEAR(seen.depth, 3, 1e-5);
            const ViewProjection::Projected sky = view.project(direction, 0);
            EXPECT_NEAR(sky.x, float(x) + 0.5f, 1e-3);
        }
    EXPECT_LE(view.project({0, 0, 1}, 1).depth, 0) << "behind the eye";
}

TEST(ViewProjection, ProjectsOrthographically) {
    gpu::FrameParams frame{};
    frame.right = {1, 0, 0};
    frame.up = {0, 1, 0};
    frame.forward = {0, 0, -1};
    frame.half_window = 2;
    frame.aspect = float(kSize.width) / kSize.height;
    frame.picture_width = kSize.width;
    frame.picture_height = kSize.height;
    const ViewProjection view(frame);
    for (float depth : {1.0f, 9.0f}) {
        const ViewProjection::Projected seen = view.project({1, -1, -depth}, 1);
        EXPECT_NEAR(seen.x, kSize.width / 2 + kSize.height / 4.0f, 1e-3);
        EXPECT_NEAR(seen.y, kSize.height * 3 / 4.0f, 1e-3);
    }
}

/// A plane at a known depth moves by eye / depth. Each point must land in the right pixel, to 1/1000 of a pixel.
TEST(RenderCache, ReprojectsPointsExactly) {
    ErrorMap errors(kSize);
    RenderCache cache = pictureFromZero(errors);
    const float eye = 0.137f, shift = eye * pixelsPerUnit(kWallAhead);
    cache.reproject(viewFrom(eye));
    int checked = 0;
    for (std::uint32_t pixel = 0; pixel < kSize.width * kSize.height; ++pixel) {
        const PixelKey key = cache.keys()[pixel];
        if (key == kEmptyPixel || depthOf(key) < 3) continue;
        const CachedPoint point = cache.points().at(pointOf(key));
        const float from = point.position.x * pixelsPerUnit(kWallAhead) + kSize.width / 2.0f;
        EXPECT_NEAR(from - std::floor(from), 0.5f, 1e-3) << "a pixel's middle when it was traced";
        EXPECT_EQ(std::floor(from - shift), float(pixel % kSize.width));
        ++checked;
    }
    EXPECT_GT(checked, 9000);
}

/// The eye moves right: the card occludes other parts of the wall and disoccludes a strip at its right edge, as wide as
/// its parallax.
TEST(RenderCache, FindsDisocclusions) {
    ErrorMap errors(kSize);
    RenderCache cache = pictureFromZero(errors);
    const ViewProjection moved = viewFrom(0.25f);
    cache.reproject(moved);
    const float strip = 0.25f * (pixelsPerUnit(kCardAhead) - pixelsPerUnit(kWallAhead)); // 6
    ASSERT_NEAR(strip, 6, 1e-4);
    const std::uint32_t y = kSize.height / 2;
    std::uint32_t empty_pixels = 0, card = 0;
    for (std::uint32_t x = 20; x < kSize.width - 20; ++x) {
        const std::uint32_t pixel = y * kSize.width + x;
        if (cache.isEmpty(pixel)) {
            ++empty_pixels;
            EXPECT_FALSE(seesCard(moved, pixel));
            EXPECT_TRUE(seesCard(moved, pixel - 7)) << "beside the card's right edge";
        } else {
            card += cache.colors()[pixel] == kCard ? 1 : 0;
            EXPECT_EQ(cache.colors()[pixel] == kCard, seesCard(moved, pixel)) << x;
        }
    }
    EXPECT_EQ(empty_pixels, 6u);
    EXPECT_EQ(card, 48u);
    fillHoles(cache);
    for (std::uint32_t x = 20; x < kSize.width - 20; ++x)
        EXPECT_EQ(cache.colors()[y * kSize.width + x] == kCard, seesCard(moved, y * kSize.width + x))
            << "no card smeared";
}

/// From nearby, the card's points leave gaps, through which nothing behind it may be visible.
TEST(RenderCache, HidesPointsBehindASurface) {
    RenderCache cache(kSize);
    ErrorMap errors(kSize);
    const ViewProjection right = viewFrom(0.5f), left = viewFrom(0);
    insertSamples(cache, errors, right, {}, tracedAll(right));
    cache.reproject(left); // wall points that the card hides from here were traced from there
    std::vector<TracedPixel> card;
    for (std::uint32_t pixel = 0; pixel < kSize.width * kSize.height; ++pixel)
        if (seesCard(left, pixel) && pixel % 3 != 0) card.push_back(traced(left, pixel));
    insertSamples(cache, errors, left, {}, card);
    cache.reproject(left);
    fillHoles(cache);
    for (std::uint32_t pixel = 0; pixel < kSize.width * kSize.height; ++pixel) {
        const gpu::vec3 direction = left.direction(pixel % kSize.width, pixel / kSize.width);
        if (std::abs(kCardAhead * direction.x) < 0.45f && std::abs(kCardAhead * direction.y) < 0.45f) {
            EXPECT_EQ(cache.colors()[pixel], kCard);
        }
    }
}

/// Every fifth pixel of every fifth row.
std::vector<TracedPixel> tracedSparsely(const ViewProjection& view) {
    std::vector<TracedPixel> some;
    for (std::uint32_t y = 2; y < kSize.height; y += 5)
        for (std::uint32_t x = 2; x < kSize.width; x += 5) some.push_back(traced(view, y * kSize.width + x));
    return some;
}

/// The same where a slow tracer has reached only few pixels, whose neighbours are empty. Beside the card, the wall
/// remains. At its rim both are accepted: points are 0.1 apart.
TEST(RenderCache, HidesPointsBehindASparseSurface) {
    RenderCache cache(kSize);
    ErrorMap errors(kSize);
    const ViewProjection right = viewFrom(0.8f), left = viewFrom(0);
    const std::vector<TracedPixel> some = tracedSparsely(right);
    insertSamples(cache, errors, right, {}, some);
    cache.reproject(left);
    const auto isBehindCard = [&](std::uint32_t pixel, float margin) {
        const gpu::vec3 direction = left.direction(pixel % kSize.width, pixel / kSize.width);
        return kCardAhead * std::max(std::abs(direction.x), std::abs(direction.y)) < 0.5f + margin;
    };
    std::size_t hidden = 0, beside = 0;
    for (const TracedPixel& each : some) {
        if (each.color != kWall) continue;
        const ViewProjection::Projected at = left.project(toCachedPoint(right, each, 0).position, 1);
        if (!(at.x >= 0 && at.y >= 0 && at.x < kSize.width && at.y < kSize.height)) continue;
        const std::uint32_t pixel = static_cast<std::uint32_t>(at.y) * kSize.width + static_cast<std::uint32_t>(at.x);
        const bool is_wall = !cache.isEmpty(pixel) && cache.colors()[pixel] == kWall;
        hidden += isBehindCard(pixel, -0.15f) ? 1 : 0;
        EXPECT_FALSE(is_wall && isBehindCard(pixel, -0.15f)) << at.x << ", " << at.y;
        beside += isBehindCard(pixel, 0.02f) ? 0 : 1;
        EXPECT_TRUE(is_wall || isBehindCard(pixel, 0.02f)) << at.x << ", " << at.y;
    }
    EXPECT_GT(hidden, 8u);
    EXPECT_GT(beside, 300u);
}

/// Moving away and back neither loses nor moves points, although the card hid some of them in between.
TEST(RenderCache, ComesBack) {
    ErrorMap errors(kSize);
    RenderCache cache = pictureFromZero(errors);
    const std::vector<std::uint32_t> before = cache.colors();
    for (float eye : {0.01f, 0.02f, 0.05f, 0.033f, 0.0f}) cache.reproject(viewFrom(eye));
    EXPECT_EQ(cache.colors(), before);
    EXPECT_EQ(cache.emptyPixelCount(), 0u);
}

TEST(RenderCache, KeepsPositionsWhenLightChanges) {
    ErrorMap errors(kSize);
    RenderCache cache = pictureFromZero(errors);
    const std::vector<std::uint32_t> before = cache.colors();
    cache.invalidateLighting(false, 1);
    cache.reproject(viewFrom(0));
    EXPECT_EQ(cache.colors(), before) << "until it is traced anew";
    EXPECT_EQ(cache.emptyPixelCount(), 0u);
    for (PixelKey key : cache.keys()) {
        const std::uint32_t info = cache.points().info[pointOf(key)];
        EXPECT_GE((1 - info) & kPointFrameMask, 64u) << "old";
        EXPECT_EQ(info >> kPointSamplesShift & kPointMaxSamples, 0u) << "the next sample replaces it";
    }
    // the wall is a shape, the card is not
    cache.invalidateLighting(true, 2);
    cache.reproject(viewFrom(0));
    EXPECT_EQ(cache.emptyPixelCount(), kSize.width * kSize.height - 48 * 48);
}

TEST(RenderCache, ResamplesToOnePointPerPixel) {
    ErrorMap errors(kSize);
    RenderCache cache = pictureFromZero(errors);
    gpu::FrameParams frame{};
    const ViewProjection nearer = [&] { // magnified
        frame.right = {1, 0, 0};
        frame.up = {0, 1, 0};
        frame.forward = {0, 0, -1};
        frame.tan_half_fov = kTan / 1.5f;
        frame.aspect = float(kSize.width) / kSize.height;
        frame.picture_width = kSize.width;
        frame.picture_height = kSize.height;
        return ViewProjection(frame);
    }();
    cache.reproject(nearer);
    const std::uint32_t gaps = fillHoles(cache);
    EXPECT_GT(gaps, kSize.width * kSize.height / 2);
    resamplePoints(cache, nearer);
    const std::vector<std::uint32_t> before = cache.colors();
    cache.reproject(nearer);
    EXPECT_LT(cache.emptyPixelCount(), kSize.width * kSize.height / 25); // at the card's edges only
    fillHoles(cache);
    std::size_t other = 0;
    for (std::size_t i = 0; i < before.size(); ++i) other += before[i] != cache.colors()[i] ? 1 : 0;
    EXPECT_LT(other, before.size() / 25);
}

TEST(SelectPixels, EmptyPixelsFirst_OthersByAge) {
    ErrorMap errors(kSize);
    RenderCache cache = pictureFromZero(errors);
    cache.reproject(viewFrom(0.25f));
    const std::uint32_t empty_pixels = cache.emptyPixelCount();
    ASSERT_GT(empty_pixels, 500u);
    std::vector<int> times(kSize.width * kSize.height);
    std::uint32_t chosen = 0;
    for (std::uint32_t frame = 1; frame <= 40; ++frame)
        for (std::uint32_t pixel : selectPixels(cache, errors, {{80, 48}, frame, true, 400})) {
            ++chosen;
            ++times[pixel];
        }
    EXPECT_NEAR(chosen, 40 * 400, 40 * 40);
    // each frame considers one row in four
    for (std::uint32_t pixel = 0; pixel < times.size(); ++pixel) {
        EXPECT_GE(times[pixel], cache.isEmpty(pixel) ? 9 : 0);
        EXPECT_LE(times[pixel], cache.isEmpty(pixel) ? 10 : 2);
    }
}

/// Where a traced colour differs from the cached one, the tile and its neighbours get priority. The left half of the
/// picture is sky, known from one pixel in each tile; the right half is a wall.
TEST(SelectPixels, SkyHasTime) {
    RenderCache cache(kSize);
    ErrorMap errors(kSize);
    const ViewProjection view = viewFrom(0);
    std::vector<TracedPixel> known;
    for (std::uint32_t y = 4; y < kSize.height; y += TILE_SIDE)
        for (std::uint32_t x = 4; x < kSize.width; x += TILE_SIDE)
            known.push_back({y * kSize.width + x, kWall, x < kSize.width / 2 ? -1.0f : kWallAhead, 0, false});
    insertSamples(cache, errors, view, {}, known);
    std::size_t left = 0, right = 0;
    for (std::uint32_t frame = 1; frame <= 4; ++frame)
        for (const std::uint32_t pixel : selectPixels(cache, errors, {{80, 48}, frame, true, 500}))
            ++(pixel % kSize.width < kSize.width / 2 - TILE_SIDE ? left : right);
    EXPECT_GT(left, 20u);
    EXPECT_GT(right, 5 * left);
}

TEST(SelectPixels, ErrorsAttractSamples) {
    ErrorMap errors(kSize);
    RenderCache cache = pictureFromZero(errors);
    TracedPixel shadowed = traced(viewFrom(0), 40 * kSize.width + 20);
    shadowed.color = 0xFF000000;
    insertSamples(cache, errors, viewFrom(0), {1}, std::vector{shadowed});
    errors.advanceFrame();
    std::uint32_t near = 0, all = 0;
    for (std::uint32_t frame = 2; frame < 10; ++frame)
        for (std::uint32_t pixel : selectPixels(cache, errors, {{80, 48}, frame, false, 200})) {
            const int x = int(pixel % kSize.width) / 8, y = int(pixel / kSize.width) / 8;
            near += std::abs(x - 2) <= 1 && std::abs(y - 5) <= 1 ? 1 : 0;
            ++all;
        }
    EXPECT_GT(near, all / 4) << "of a thirtieth of the picture";
}

} // namespace
} // namespace pointrt
