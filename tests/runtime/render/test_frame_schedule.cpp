// SPDX-License-Identifier: Apache-2.0
// Which samples a frame takes, with a tracer that only counts, and a clock that its samples advance.
#include "runtime/render/frame_schedule.h"
#include "runtime/scene/render_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace pointrt {
namespace {

Film blankFilm(std::uint32_t width, std::uint32_t height) {
    Film film;
    film.width = width;
    film.height = height;
    film.samples.assign(std::size_t{width} * height, 0.0f);
    return film;
}

/// A tracer whose noise is 1 / sqrt(samples). A sample of all rows takes a second, of a band its share of that.
struct FakeTracer {
    double now = 100;                              // an arbitrary start
    std::map<std::uint32_t, std::uint32_t> traced; ///< by first row
    std::uint32_t opened = 0, looks = 0;

    FrameGauges gauges() {
        return {[this] {
                    ++looks;
                    return 1 / std::sqrt(traced[0]);
                },
                [this] { return now; }};
    }

    FrameState run(const FrameJob& job, const Film& film, std::uint32_t band_rows) {
        const std::vector<FrameBand> bands = frameBands(film, band_rows);
        for (const FrameBand& band : bands) traced[band.band.first_row] = band.samples;
        FrameSchedule schedule(job, bands, gauges());
        const FrameBand* open = nullptr;
        while (const FrameBand* band = schedule.next()) {
            if (band != open) ++opened;
            open = band;
            EXPECT_EQ(traced[band->band.first_row]++, band->samples);
            now += static_cast<double>(band->band.rows) / film.height;
            schedule.addRows(band->band.rows);
        }
        return schedule.state();
    }
};

TEST(FrameSchedule, TakesAllSamplesOfABandAtOnceWithoutLimits) {
    FakeTracer tracer;
    FrameJob job;
    job.samples = 5;
    double share = 0;
    job.progress = [&](const FrameState&, double done) {
        EXPECT_GT(done, share);
        share = done;
    };
    const FrameState state = tracer.run(job, blankFilm(3, 25), 10);
    EXPECT_EQ(tracer.traced, (std::map<std::uint32_t, std::uint32_t>{{0, 5}, {10, 5}, {20, 5}}));
    EXPECT_EQ(tracer.opened, 3u);
    EXPECT_EQ(state.samples, 5u);
    EXPECT_NEAR(state.traced, 5, 1e-9);
    EXPECT_NEAR(share, 1, 1e-9);
}

TEST(FrameSchedule, ContinuesEachBandFromItsSamples) {
    Film film = blankFilm(2, 4);
    film.samples = {7, 7, 3, 3, 3, 3, 9, 9};
    FakeTracer tracer;
    FrameJob job;
    job.samples = 8;
    const FrameState state = tracer.run(job, film, 4);
    EXPECT_EQ(tracer.traced, (std::map<std::uint32_t, std::uint32_t>{{0, 8}, {1, 8}, {3, 9}}));
    EXPECT_EQ(state.samples, 8u);
    EXPECT_NEAR(state.traced, (1 + 2 * 5) / 4.0, 1e-9);
}

TEST(FrameSchedule, CompleteFilmsNeedNoSamples) {
    Film film = blankFilm(1, 2);
    film.samples = {8, 8};
    FakeTracer tracer;
    FrameJob job;
    job.samples = 8;
    EXPECT_EQ(tracer.run(job, film, 1).traced, 0);
    EXPECT_EQ(tracer.opened, 0u);
}

TEST(FrameSchedule, StopsAtTheTimeLimit) {
    for (const double seconds : {0.3, 1.0, 2.0, 7.9, 100.5}) {
        FrameJob job;
        job.samples = kMaxSpp;
        job.limits.seconds = seconds;
        for (const std::uint32_t band_rows : {16u, 3u}) {
            FakeTracer tracer;
            const FrameState state = tracer.run(job, blankFilm(1, 16), band_rows);
            EXPECT_EQ(state.samples, std::max(1u, static_cast<std::uint32_t>(seconds + 1e-6))) << seconds;
            EXPECT_LE(state.seconds, std::max(1.0, seconds) + 1e-6);
        }
    }
}

TEST(FrameSchedule, ResumedFilmsGetASampleInAnyTime) {
    Film film = blankFilm(1, 1);
    film.samples = {32};
    FakeTracer tracer;
    FrameJob job;
    job.samples = kMaxSpp;
    job.limits.seconds = 0.001;
    EXPECT_EQ(tracer.run(job, film, 1).samples, 33u);
}

TEST(FrameSchedule, StopsAtTheNoiseLimit) {
    FrameJob job;
    job.samples = kMaxSpp;
    job.limits.noise = 0.05; // 400 samples
    FakeTracer tracer;
    const FrameState state = tracer.run(job, blankFilm(1, 16), 16);
    EXPECT_GE(state.samples, 400u);
    EXPECT_LE(state.samples, 402u); // the target, apart from rounding, and one more step
    EXPECT_LE(*state.noise, 0.05);
    EXPECT_LE(tracer.looks, 9u) << "at 8, 16, ... 256 and the end";
}

TEST(FrameSchedule, LimitsNeverAddSamples) {
    FrameJob job;
    job.samples = 50;
    job.limits = {1000, 0.001};
    FakeTracer tracer;
    EXPECT_EQ(tracer.run(job, blankFilm(1, 16), 5).samples, 50u);
}

TEST(FrameSchedule, InterruptedFramesHaveSamplesEverywhere) {
    FakeTracer tracer;
    FrameJob job;
    job.samples = 1000;
    job.interrupted = [&] { return tracer.now > 110; };
    const FrameState state = tracer.run(job, blankFilm(1, 10), 5);
    EXPECT_EQ(state.samples, 8u); // 1, 2, 4 and 8 samples in both bands take 8 of 10 seconds
    EXPECT_EQ(tracer.traced[0], 13u) << "the current sample is finished";
    EXPECT_EQ(tracer.traced[5], 8u);
}

TEST(FrameSchedule, TakesAllSamplesOfABandAtOnceIfBandByBand) {
    FakeTracer tracer;
    FrameJob job;
    job.samples = 5;
    job.interrupted = [] { return false; };
    job.band_by_band = true;
    tracer.run(job, blankFilm(3, 25), 10);
    EXPECT_EQ(tracer.opened, 3u);
}

TEST(FrameSchedule, AbortsALateSample) {
    FakeTracer tracer;
    FrameJob job;
    job.samples = kMaxSpp;
    job.limits.seconds = 3;
    FrameSchedule schedule(job, emptyBands(64, 32), tracer.gauges());
    ASSERT_NE(schedule.next(), nullptr);
    schedule.addRows(16);
    tracer.now += 3 + kTimeOverrun_s;
    EXPECT_FALSE(schedule.shouldAbort());
    tracer.now += 0.1;
    EXPECT_TRUE(schedule.shouldAbort());
    EXPECT_EQ(schedule.state().samples, 0u);
    EXPECT_EQ(schedule.state().empty_rows, 48u);
    EXPECT_NEAR(schedule.state().traced, 0.25, 1e-9);
    schedule.addRows(16);
    EXPECT_EQ(schedule.next(), nullptr) << "no other band begins either";
    EXPECT_EQ(schedule.state().empty_rows, 32u);
}

TEST(FrameSchedule, ContinuesIfMoreSamplesAreRequested) {
    FrameJob job;
    job.samples = 2;
    FakeTracer tracer;
    FrameSchedule schedule(job, emptyBands(5, 3), tracer.gauges());
    const auto count = [&] {
        int samples = 0;
        for (; const FrameBand* band = schedule.next(); ++samples) schedule.addRows(band->band.rows);
        return samples;
    };
    EXPECT_EQ(count(), 4) << "of two bands";
    EXPECT_EQ(count(), 0);
    schedule.setSamples(5);
    const FrameBand* band = schedule.next();
    ASSERT_NE(band, nullptr);
    schedule.addRows(band->band.rows);
    EXPECT_EQ(schedule.samples(), 2u) << "of the other band";
    schedule.setSamples(3);
    EXPECT_EQ(count(), 1);
    EXPECT_EQ(schedule.samples(), 3u);
}

TEST(FrameBands, CoverTheFilm) {
    const std::vector<FrameBand> bands = emptyBands(25, 10), same = frameBands(blankFilm(3, 25), 10);
    ASSERT_EQ(bands.size(), same.size());
    for (std::size_t i = 0; i < bands.size(); ++i) {
        EXPECT_EQ(bands[i].band.first_row, same[i].band.first_row);
        EXPECT_EQ(bands[i].band.rows, same[i].band.rows);
    }
}

Film filmOf(std::vector<float> lights, std::vector<float> variances) {
    Film film = blankFilm(static_cast<std::uint32_t>(lights.size()), 1);
    for (const float light : lights) film.rgba.insert(film.rgba.end(), {light, light, light, 1});
    film.variance = std::move(variances);
    film.samples.assign(lights.size(), 4.0f);
    return film;
}

TEST(RelativeNoise, IsTheStandardErrorRelativeToTheLight) {
    EXPECT_NEAR(relativeNoise(filmOf({2}, {0.01f})), 0.1 / (2 + 0.02), 1e-6);
    // mean 1.5: sqrt((0.1 / 1.015)^2 / 2 + (0.4 / 2.015)^2 / 2)
    EXPECT_NEAR(relativeNoise(filmOf({1, 2}, {0.01f, 0.16f})), 0.156706, 1e-5);
    EXPECT_EQ(relativeNoise(filmOf({0, 0}, {0, 0})), 0);
}

TEST(RelativeNoise, IsUnknownAfterOneSample) {
    Film film = filmOf({1, 1}, {0, 0});
    film.samples[1] = 1;
    EXPECT_EQ(relativeNoise(film), std::numeric_limits<double>::infinity());
}

TEST(RelativeNoise, DoesNotDependOnHowRowsAreAdded) {
    const Film one = filmOf({2}, {0.01f}), other = filmOf({0.5f}, {0.16f});
    NoiseMeter meter(2);
    meter.addRows(one);
    meter.addRows(other);
    EXPECT_NEAR(meter.noise(), relativeNoise(filmOf({2, 0.5f}, {0.01f, 0.16f})), 1e-7);
    meter.addRows(blankFilm(1, 1));
    EXPECT_EQ(meter.noise(), std::numeric_limits<double>::infinity());
}

TEST(RelativeNoise, IgnoresNonFinitePixels) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NEAR(relativeNoise(filmOf({2, nan}, {0.01f, nan})), 0.1 / (2 + 0.01) / std::sqrt(2.0), 1e-6);
}

} // namespace
} // namespace pointrt
