// SPDX-License-Identifier: Apache-2.0
// Preview sizes for a time budget, and frame statistics.
#include "runtime/window/live/trace_speed.h"

#include <gtest/gtest.h>

#include "runtime/window/live/frame_times.h"

namespace pointrt {
namespace {

constexpr PixelSize kFull{1280, 720};
constexpr double kBudget_s = 0.014;

std::uint64_t area(PixelSize size) { return std::uint64_t{size.width} * size.height; }

/// The size after some frames at a constant speed.
PixelSize settled(TraceSpeed& speed, double seconds_per_pixel, PixelSize last = kFull) {
    for (int frame = 0; frame < 60; ++frame) {
        last = speed.previewSize(kBudget_s, kFull, last);
        speed.addMeasurement(area(last), seconds_per_pixel * static_cast<double>(area(last)));
    }
    return last;
}

TEST(TraceSpeed, FillsTheBudgetAndNoMore) {
    for (const double seconds_per_pixel : {1e-9, 1e-8, 3e-8, 1e-7, 4e-7, 1e-6, 2e-6}) {
        TraceSpeed speed;
        const PixelSize size = settled(speed, seconds_per_pixel);
        const double seconds = seconds_per_pixel * static_cast<double>(area(size));
        EXPECT_LE(seconds, kBudget_s) << seconds_per_pixel;
        // sizes differ by a factor of 1.4 in area, and a finer one needs some margin
        if (size != kFull) {
            EXPECT_GT(seconds, 0.5 * kBudget_s) << seconds_per_pixel;
        }
        EXPECT_NEAR(double(size.width) / size.height, 16.0 / 9, 0.05);
    }
}

TEST(TraceSpeed, SlowTracersKeepAMinimumSize) {
    TraceSpeed speed;
    const PixelSize size = settled(speed, 1.0);
    EXPECT_GE(size.width, 1280u / 20);
    EXPECT_GE(size.height, 720u / 20);
}

TEST(TraceSpeed, DoesNotFlickerBetweenSizes) {
    // a speed that varies by 10 percent around the boundary of two sizes
    TraceSpeed speed;
    PixelSize last = settled(speed, 2.5e-7);
    int changes = 0;
    for (int frame = 0; frame < 200; ++frame) {
        const double wavering = 2.5e-7 * (frame % 2 ? 1.05 : 0.95);
        const PixelSize size = speed.previewSize(kBudget_s, kFull, last);
        changes += size != last;
        last = size;
        speed.addMeasurement(area(size), wavering * static_cast<double>(area(size)));
    }
    EXPECT_LE(changes, 1);
}

TEST(TraceSpeed, SlowsDownAtOnce) {
    TraceSpeed speed;
    PixelSize last = settled(speed, 1e-8);
    int late = 0;
    for (int frame = 0; frame < 10; ++frame) {
        last = speed.previewSize(kBudget_s, kFull, last);
        const double seconds = 1e-6 * static_cast<double>(area(last));
        late += seconds > 2 * kBudget_s;
        speed.addMeasurement(area(last), seconds);
    }
    EXPECT_LE(late, 2);
}

TEST(TraceSpeed, RowsAreMultiplesOfTiles) {
    TraceSpeed speed;
    speed.addMeasurement(1000, 1e-3); // one microsecond per pixel
    EXPECT_EQ(speed.rowsFor(0.0128, 100), 128u);
    EXPECT_EQ(speed.rowsFor(0.0127, 100), 120u);
    EXPECT_EQ(speed.rowsFor(0, 100), 8u);
    EXPECT_EQ(speed.rowsFor(1e9, 1) % 8, 0u);
}

TEST(TraceSpeed, ListsFillTheFrameUpToMost) {
    const ListCost cost{0.010, 1e-6};
    EXPECT_NEAR(pixelsFor(0.030, cost, 1e6), 20000, 1e-6);
    EXPECT_EQ(pixelsFor(0.030, cost, 1000), 1000);
    EXPECT_NEAR(pixelsFor(0.005, cost, 1e6), 1500, 1e-6); // a share of the frame in any case
    EXPECT_EQ(pixelsFor(0.030, {0.010, 1e-3}, 1e6), 512);
}

TEST(TraceSpeed, ReducedSizeIsNeverZero) {
    EXPECT_EQ(reduced({1, 1}, 16), (PixelSize{1, 1}));
    EXPECT_EQ(reduced({1280, 720}, 2), (PixelSize{640, 360}));
    EXPECT_EQ(reduced({3, 5}, 2), (PixelSize{2, 3}));
}

TEST(FrameTimes, PercentilesUseTheNearestRank) {
    std::vector<double> values;
    for (int i = 100; i >= 1; --i) values.push_back(i);
    const Percentiles p = percentilesOf(values);
    EXPECT_EQ(p.count, 100u);
    EXPECT_EQ(p.median, 50);
    EXPECT_EQ(p.p95, 95);
    EXPECT_EQ(p.p99, 99);
    EXPECT_EQ(p.most, 100);
    EXPECT_EQ(percentilesOf({7}).p95, 7);
    EXPECT_EQ(percentilesOf({}).count, 0u);
}

} // namespace
} // namespace pointrt
