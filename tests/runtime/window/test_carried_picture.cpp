// SPDX-License-Identifier: Apache-2.0
// Points carried from camera to camera, in scenes whose pictures are known: a wall, and a card before it.
#include "runtime/window/live/carried_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "runtime/window/live/deposit.h"
#include "runtime/window/live/hole_filling.h"
#include "runtime/window/live/urgency.h"

namespace pointrt {
namespace {

constexpr PixelSize kSize{160, 96};
constexpr float kWallAhead = 4, kCardAhead = 2, kTan = 0.5f;

/// Looking along -z from (x, 0, 0).
CarryView viewFrom(float x) {
    gpu::FrameParams frame{};
    frame.eye = {x, 0, 0};
    frame.right = {1, 0, 0};
    frame.up = {0, 1, 0};
    frame.forward = {0, 0, -1};
    frame.tan_half_fov = kTan;
    frame.aspect = float(kSize.width) / kSize.height;
    frame.picture_width = kSize.width;
    frame.picture_height = kSize.height;
    return CarryView(frame);
}

float pixelsPerUnit(float ahead) { return kSize.height / (2 * kTan * ahead); }

/// The card is the square from -0.5 to 0.5 of x and y.
bool seesCard(const CarryView& view, std::uint32_t pixel) {
    const gpu::vec3 start = view.start(0, 0), way = view.way(pixel % kSize.width, pixel / kSize.width);
    return std::abs(start.x + kCardAhead * way.x) < 0.5f && std::abs(kCardAhead * way.y) < 0.5f;
}

constexpr std::uint32_t kCard = 0xFFC08040, kWall = 0xFF204060;

TracedPixel traced(const CarryView& view, std::uint32_t pixel) {
    const gpu::vec3 way = view.way(pixel % kSize.width, pixel / kSize.width);
    const float length = std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
    const bool card = seesCard(view, pixel);
    return {pixel, card ? kCard : kWall, (card ? kCardAhead : kWallAhead) * length, 0, !card};
}

std::vector<TracedPixel> tracedAll(const CarryView& view) {
    std::vector<TracedPixel> all;
    for (std::uint32_t pixel = 0; pixel < kSize.width * kSize.height; ++pixel) all.push_back(traced(view, pixel));
    return all;
}

/// What is seen from x = 0, traced in frame 0.
CarriedPicture pictureFromZero(ErrorMap& errors) {
    CarriedPicture picture(kSize);
    const CarryView view = viewFrom(0);
    depositPixels(picture, errors, view, {}, tracedAll(view));
    return picture;
}

TEST(CarryView, ProjectsMiddlesToMiddles) {
    const CarryView view = viewFrom(0.3f);
    for (std::uint32_t y : {0u, 17u, 95u})
        for (std::uint32_t x : {0u, 80u, 159u}) {
            const gpu::vec3 start = view.start(x, y), way = view.way(x, y);
            const CarryView::Seen seen =
                view.project({start.x + 3 * way.x, start.y + 3 * way.y, start.z + 3 * way.z}, 1);
            EXPECT_NEAR(seen.x, float(x) + 0.5f, 1e-3);
            EXPECT_NEAR(seen.y, float(y) + 0.5f, 1e-3);
            EXPECT_NEAR(seen.ahead, 3, 1e-5);
            const CarryView::Seen sky = view.project(way, 0);
            EXPECT_NEAR(sky.x, float(x) + 0.5f, 1e-3);
        }
    EXPECT_LE(view.project({0, 0, 1}, 1).ahead, 0) << "behind the eye";
}

TEST(CarryView, ProjectsInParallel) {
    gpu::FrameParams frame{};
    frame.right = {1, 0, 0};
    frame.up = {0, 1, 0};
    frame.forward = {0, 0, -1};
    frame.half_window = 2;
    frame.aspect = float(kSize.width) / kSize.height;
    frame.picture_width = kSize.width;
    frame.picture_height = kSize.height;
    const CarryView view(frame);
    for (float ahead : {1.0f, 9.0f}) {
        const CarryView::Seen seen = view.project({1, -1, -ahead}, 1);
        EXPECT_NEAR(seen.x, kSize.width / 2 + kSize.height / 4.0f, 1e-3);
        EXPECT_NEAR(seen.y, kSize.height * 3 / 4.0f, 1e-3);
    }
}

/// A plane at a known depth moves by eye / depth: each point to the pixel that it lies in, to a thousandth of one.
TEST(CarriedPicture, PutsPointsWhereTheyAreSeen) {
    ErrorMap errors(kSize);
    CarriedPicture picture = pictureFromZero(errors);
    const float eye = 0.137f, shift = eye * pixelsPerUnit(kWallAhead);
    picture.carryTo(viewFrom(eye));
    int checked = 0;
    for (std::uint32_t pixel = 0; pixel < kSize.width * kSize.height; ++pixel) {
        const PixelKey key = picture.keys()[pixel];
        if (key == kNoPoint || aheadIn(key) < 3) continue;
        const CarriedPoint point = picture.points().at(pointIn(key));
        const float from = point.place.x * pixelsPerUnit(kWallAhead) + kSize.width / 2.0f;
        EXPECT_NEAR(from - std::floor(from), 0.5f, 1e-3) << "a pixel's middle when it was traced";
        EXPECT_EQ(std::floor(from - shift), float(pixel % kSize.width));
        ++checked;
    }
    EXPECT_GT(checked, 9000);
}

/// The eye moves to the right: the card covers other parts of the wall, and lays a strip bare on its right, as wide as
/// it has moved against the wall.
TEST(CarriedPicture, FindsWhatComesToLight) {
    ErrorMap errors(kSize);
    CarriedPicture picture = pictureFromZero(errors);
    const CarryView moved = viewFrom(0.25f);
    picture.carryTo(moved);
    const float strip = 0.25f * (pixelsPerUnit(kCardAhead) - pixelsPerUnit(kWallAhead)); // 6
    ASSERT_NEAR(strip, 6, 1e-4);
    const std::uint32_t y = kSize.height / 2;
    std::uint32_t holes = 0, card = 0;
    for (std::uint32_t x = 20; x < kSize.width - 20; ++x) {
        const std::uint32_t pixel = y * kSize.width + x;
        if (picture.isHole(pixel)) {
            ++holes;
            EXPECT_FALSE(seesCard(moved, pixel));
            EXPECT_TRUE(seesCard(moved, pixel - 7)) << "beside the card's right edge";
        } else {
            card += picture.shown()[pixel] == kCard ? 1 : 0;
            EXPECT_EQ(picture.shown()[pixel] == kCard, seesCard(moved, pixel)) << x;
        }
    }
    EXPECT_EQ(holes, 6u);
    EXPECT_EQ(card, 48u);
    fillHoles(picture);
    for (std::uint32_t x = 20; x < kSize.width - 20; ++x)
        EXPECT_EQ(picture.shown()[y * kSize.width + x] == kCard, seesCard(moved, y * kSize.width + x))
            << "no card smeared";
}

/// Nearer, the card's points leave gaps: nothing of what is behind it is seen through them.
TEST(CarriedPicture, HidesWhatIsBehindASurface) {
    CarriedPicture picture(kSize);
    ErrorMap errors(kSize);
    const CarryView right = viewFrom(0.5f), left = viewFrom(0);
    depositPixels(picture, errors, right, {}, tracedAll(right));
    picture.carryTo(left); // the wall that the card hides from here is known from there
    std::vector<TracedPixel> card;
    for (std::uint32_t pixel = 0; pixel < kSize.width * kSize.height; ++pixel)
        if (seesCard(left, pixel) && pixel % 3 != 0) card.push_back(traced(left, pixel));
    depositPixels(picture, errors, left, {}, card);
    picture.carryTo(left);
    fillHoles(picture);
    for (std::uint32_t pixel = 0; pixel < kSize.width * kSize.height; ++pixel) {
        const gpu::vec3 way = left.way(pixel % kSize.width, pixel / kSize.width);
        if (std::abs(kCardAhead * way.x) < 0.45f && std::abs(kCardAhead * way.y) < 0.45f) {
            EXPECT_EQ(picture.shown()[pixel], kCard);
        }
    }
}

/// There and back again nothing has been lost or moved, though the card hid some of it meanwhile.
TEST(CarriedPicture, ComesBack) {
    ErrorMap errors(kSize);
    CarriedPicture picture = pictureFromZero(errors);
    const std::vector<std::uint32_t> before = picture.shown();
    for (float eye : {0.01f, 0.02f, 0.05f, 0.033f, 0.0f}) picture.carryTo(viewFrom(eye));
    EXPECT_EQ(picture.shown(), before);
    EXPECT_EQ(picture.holeCount(), 0u);
}

TEST(CarriedPicture, KeepsPlacesWhereLightChanges) {
    ErrorMap errors(kSize);
    CarriedPicture picture = pictureFromZero(errors);
    const std::vector<std::uint32_t> before = picture.shown();
    picture.noteSceneChange(false, 1);
    picture.carryTo(viewFrom(0));
    EXPECT_EQ(picture.shown(), before) << "until it is traced anew";
    EXPECT_EQ(picture.holeCount(), 0u);
    for (PixelKey key : picture.keys()) {
        const std::uint32_t info = picture.points().info[pointIn(key)];
        EXPECT_GE((1 - info) & kCarriedFrames, 64u) << "old";
        EXPECT_EQ(info >> kCarriedSamplesShift & kCarriedSamplesMost, 0u) << "the next sample replaces it";
    }
    // the wall is a shape, the card is none
    picture.noteSceneChange(true, 2);
    picture.carryTo(viewFrom(0));
    EXPECT_EQ(picture.holeCount(), kSize.width * kSize.height - 48 * 48);
}

TEST(CarriedPicture, BecomesOnePointAPixelAgain) {
    ErrorMap errors(kSize);
    CarriedPicture picture = pictureFromZero(errors);
    gpu::FrameParams frame{};
    const CarryView nearer = [&] { // twice as large
        frame.right = {1, 0, 0};
        frame.up = {0, 1, 0};
        frame.forward = {0, 0, -1};
        frame.tan_half_fov = kTan / 1.5f;
        frame.aspect = float(kSize.width) / kSize.height;
        frame.picture_width = kSize.width;
        frame.picture_height = kSize.height;
        return CarryView(frame);
    }();
    picture.carryTo(nearer);
    const std::uint32_t gaps = fillHoles(picture);
    EXPECT_GT(gaps, kSize.width * kSize.height / 2);
    rebuildPoints(picture, nearer);
    const std::vector<std::uint32_t> before = picture.shown();
    picture.carryTo(nearer);
    EXPECT_LT(picture.holeCount(), kSize.width * kSize.height / 25); // at the card's edges
    fillHoles(picture);
    std::size_t other = 0;
    for (std::size_t i = 0; i < before.size(); ++i) other += before[i] != picture.shown()[i] ? 1 : 0;
    EXPECT_LT(other, before.size() / 25);
}

TEST(ChoosePixels, TakesWhatIsNewFirstAndTheRestInTurn) {
    ErrorMap errors(kSize);
    CarriedPicture picture = pictureFromZero(errors);
    picture.carryTo(viewFrom(0.25f));
    const std::uint32_t holes = picture.holeCount();
    ASSERT_GT(holes, 500u);
    std::vector<int> times(kSize.width * kSize.height);
    std::uint32_t chosen = 0;
    for (std::uint32_t frame = 1; frame <= 40; ++frame)
        for (std::uint32_t pixel : choosePixels(picture, errors, {{80, 48}, frame, true, 400})) {
            ++chosen;
            ++times[pixel];
        }
    EXPECT_NEAR(chosen, 40 * 400, 40 * 40);
    // one row of four has its turn in a frame
    for (std::uint32_t pixel = 0; pixel < times.size(); ++pixel) {
        EXPECT_GE(times[pixel], picture.isHole(pixel) ? 9 : 0);
        EXPECT_LE(times[pixel], picture.isHole(pixel) ? 10 : 2);
    }
}

/// Where a traced colour is another one than was shown, the tile and those beside it come first.
TEST(ChoosePixels, GoesWhereThePictureIsWrong) {
    ErrorMap errors(kSize);
    CarriedPicture picture = pictureFromZero(errors);
    TracedPixel shadowed = traced(viewFrom(0), 40 * kSize.width + 20);
    shadowed.color = 0xFF000000;
    depositPixels(picture, errors, viewFrom(0), {1}, std::vector{shadowed});
    errors.pass();
    std::uint32_t near = 0, all = 0;
    for (std::uint32_t frame = 2; frame < 10; ++frame)
        for (std::uint32_t pixel : choosePixels(picture, errors, {{80, 48}, frame, false, 200})) {
            const int x = int(pixel % kSize.width) / 8, y = int(pixel / kSize.width) / 8;
            near += std::abs(x - 2) <= 1 && std::abs(y - 5) <= 1 ? 1 : 0;
            ++all;
        }
    EXPECT_GT(near, all / 4) << "of a thirtieth of the picture";
}

} // namespace
} // namespace pointrt
