// SPDX-License-Identifier: Apache-2.0
// A picture rendered in slices equals one rendered at once, and the display equals the files.
#include "runtime/window/live/viewport_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <thread>

#include "runtime/gpu/device.h"
#include "runtime/image/tonemap.h"
#include "runtime/scene/camera.h"
#include "tests/support/ball_scene.h"
#include "tests/support/validated_device.h"
#include "tests/support/whole_frame.h"

namespace pointrt {
namespace {

constexpr double kSlice_s = 0.004;

RenderSettings testSettings(Integrator integrator) {
    RenderSettings settings;
    settings.width = 72;
    settings.height = 56;
    settings.spp = 4;
    settings.integrator = integrator;
    settings.caustics = false;
    return settings;
}

class ViewportRendererTest : public DeviceFixture, public testing::WithParamInterface<Integrator> {
protected:
    void SetUp() override {
        scene = openScene(device, ballScene(), false);
        view.settings = testSettings(GetParam());
        uploadSceneTables(device, scene, view.settings);
        view.camera = frameCamera({}, {-2, 0, -1}, {2, 2, 1}, 72.0 / 56);
        view.look.scale = scene.space.scale;
        createBandTracer(device, tracer, scene, view.settings, kSliceLanes, 1);
        live.emplace(device, tracer, 0.01);
    }
    void TearDown() override {
        live.reset();
        destroyBandTracer(device, tracer);
        destroyDeviceScene(device, scene);
    }

    void finish() {
        for (int i = 0; i < 100000 && !live->progress().resting; ++i) {
            live->clearUpdates();
            live->work(kSlice_s);
            // it waits for kRest_s before it refines
            if (live->updates().empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        ASSERT_TRUE(live->progress().resting);
    }

    Film headless() { return test::wholeFrame(device, scene, view.settings, view.camera); }

    std::vector<std::uint32_t> shownPixels() {
        std::vector<std::uint32_t> words(72 * 56);
        downloadBuffer(device, live->pixels(), words.data(), words.size() * 4);
        return words;
    }

    /// Mean difference of all channels, in steps of 255.
    static double errorOf(const std::vector<std::uint32_t>& words, const Image8& picture) {
        double sum = 0;
        for (std::size_t i = 0; i < words.size(); ++i)
            for (std::uint32_t c = 0; c < 3; ++c)
                sum += std::abs(static_cast<int>(words[i] >> (16 - 8 * c) & 255) - picture.pixels[3 * i + c]);
        return sum / static_cast<double>(3 * words.size());
    }

    DeviceScene scene;
    Viewport view;
    BandTracer tracer;
    std::optional<ViewportRenderer> live;
};

TEST_P(ViewportRendererTest, MatchesTheHeadlessPicture) {
    live->setView(view, true);
    finish();
    const Film film = live->readFilm(), whole = headless();
    EXPECT_EQ(film.rgba, whole.rgba);
    EXPECT_EQ(film.variance, whole.variance);
    const Image8 developed = tonemapFilm(whole);
    const std::vector<std::uint32_t> words = shownPixels();
    int worst = 0;
    for (std::size_t i = 0; i < words.size(); ++i)
        for (std::uint32_t c = 0; c < 3; ++c)
            worst = std::max(worst,
                             std::abs(static_cast<int>(words[i] >> (16 - 8 * c) & 255) - developed.pixels[3 * i + c]));
    EXPECT_LE(worst, 1); // the device's pow may round differently
}

TEST_P(ViewportRendererTest, StartsOverWhenTheCameraMoves) {
    live->setView(view, true);
    for (int i = 0; i < 20; ++i) {
        view.camera.eye = view.camera.eye + Vec3{0.01, 0, 0};
        live->setView(view, true);
        live->clearUpdates();
        live->work(kSlice_s);
        ASSERT_FALSE(live->updates().empty()) << "every moving frame has a picture";
    }
    finish();
    EXPECT_EQ(live->readFilm().rgba, headless().rgba);
}

/// On a slow device the last picture is reprojected; refinement still ends in the headless picture.
TEST_P(ViewportRendererTest, ReprojectsThePicture) {
    live.emplace(device, tracer, 1e-5); // no frame fits in that budget
    live->setView(view, true);
    finish();
    const std::vector<std::uint32_t> before = shownPixels();
    view.camera.eye = view.camera.eye + Vec3{0.01, 0, 0};
    live->setView(view, true);
    live->clearUpdates();
    live->work(kSlice_s);
    ASSERT_FALSE(live->updates().empty());
    EXPECT_EQ(live->progress().size, (PixelSize{72, 56}));
    EXPECT_EQ(live->progress().samples, 0u);
    EXPECT_GT(live->progress().traced, 0u);
    // a hundredth of the ball's distance: most pixels stay within a few steps of 255
    const std::vector<std::uint32_t> reprojected = shownPixels();
    std::size_t same = 0;
    for (std::size_t i = 0; i < reprojected.size(); ++i)
        same +=
            std::abs(static_cast<int>(reprojected[i] >> 8 & 255) - static_cast<int>(before[i] >> 8 & 255)) < 16 ? 1 : 0;
    EXPECT_GT(same, reprojected.size() * 8 / 10);
    EXPECT_NE(reprojected, before);
    finish();
    const Film film = live->readFilm(), whole = headless();
    EXPECT_EQ(film.rgba, whole.rgba);
    EXPECT_EQ(film.variance, whole.variance);
    const std::vector<std::uint32_t> words = shownPixels();
    // the same view without reprojection is bit-identical
    live.emplace(device, tracer, 0.01);
    live->setView(view, false);
    finish();
    EXPECT_EQ(shownPixels(), words);
}

/// Without an earlier picture, traced points accumulate from frame to frame.
TEST_P(ViewportRendererTest, AccumulatesWhileMoving) {
    live.emplace(device, tracer, 1e-5);
    std::vector<double> errors;
    for (int frame = 0; frame < 24; ++frame) {
        view.camera.eye = view.camera.eye + Vec3{1e-4, 0, 0};
        live->setView(view, true);
        live->clearUpdates();
        live->work(kSlice_s);
        ASSERT_FALSE(live->updates().empty()) << frame;
        EXPECT_EQ(live->progress().size, (PixelSize{72, 56})) << frame;
        if (frame == 0 || frame == 23) errors.push_back(errorOf(shownPixels(), tonemapFilm(headless())));
    }
    EXPECT_LT(errors[1], 0.65 * errors[0]); // half of the path tracer's error is noise, which remains
    finish();
    EXPECT_EQ(live->readFilm().rgba, headless().rgba);
}

/// A moved lamp changes no geometry, so the picture is reprojected.
TEST_P(ViewportRendererTest, ReprojectsWhenLightChanges) {
    live.emplace(device, tracer, 1e-5);
    live->setView(view, true);
    finish();
    const std::vector<std::uint32_t> before = shownPixels();
    live->setView(view, true, ViewChange::kScene);
    live->clearUpdates();
    live->work(kSlice_s);
    EXPECT_GT(live->progress().traced, 0u);
    const auto same = [&] {
        const std::vector<std::uint32_t> shown = shownPixels();
        std::size_t count = 0;
        for (std::size_t i = 0; i < shown.size(); ++i) count += shown[i] == before[i] ? 1 : 0;
        return count;
    };
    EXPECT_GT(same(), before.size() - live->progress().traced - 1);
    // after a change of everything the cache starts empty
    live->setView(view, true, ViewChange::kAll);
    live->work(kSlice_s);
    EXPECT_GT(live->progress().traced, 0u);
    EXPECT_LT(same(), before.size() / 2);
}

TEST_P(ViewportRendererTest, Resizes) {
    for (const std::uint32_t edge : {40u, 200u, 1u, 72u}) {
        view.settings.width = edge;
        view.settings.height = edge == 72 ? 56 : edge;
        live->setView(view, true);
        live->work(kSlice_s);
    }
    finish();
    EXPECT_EQ(live->readFilm().rgba, headless().rgba);
}

/// The film is extended when there will be several batches of samples.
TEST_P(ViewportRendererTest, KeepsItsLightWhenSamplesAreAdded) {
    view.settings.width = view.settings.height = 16;
    live->setView(view, false);
    finish();
    const std::uint64_t bytes = live->deviceBytes();
    view.settings.spp = FILM_BATCH + 4;
    live->setSamples(view.settings.spp);
    EXPECT_GT(live->deviceBytes(), bytes);
    EXPECT_EQ(live->progress().samples, 4u);
    finish();
    const Film film = live->readFilm(), whole = headless();
    EXPECT_EQ(film.rgba, whole.rgba);
    EXPECT_EQ(film.variance, whole.variance);
    const Image8 developed = tonemapFilm(whole);
    std::vector<std::uint32_t> words(16 * 16);
    downloadBuffer(device, live->pixels(), words.data(), words.size() * 4);
    for (std::size_t i = 0; i < words.size(); ++i)
        EXPECT_NEAR(static_cast<int>(words[i] >> 16 & 255), developed.pixels[3 * i], 1) << i;
}

TEST_P(ViewportRendererTest, PicksMatchFirstHits) {
    view.settings.first_hits = true;
    live->setView(view, false);
    finish();
    const Film film = headless();
    int found = 0;
    for (std::uint32_t y = 3; y < 56; y += 7)
        for (std::uint32_t x = 2; x < 72; x += 5) {
            const std::optional<Pick> pick = live->pick(x, y);
            const std::size_t at = std::size_t{y} * 72 + x;
            ASSERT_EQ(pick.has_value(), film.instance_id[at] != NO_INDEX);
            if (!pick) continue;
            ++found;
            EXPECT_EQ(pick->owner, film.instance_id[at]);
            EXPECT_FLOAT_EQ(static_cast<float>(pick->distance), film.depth[at]);
            EXPECT_FLOAT_EQ(static_cast<float>(pick->position.y), film.position[3 * at + 1]);
        }
    EXPECT_GT(found, 20);
    EXPECT_EQ(live->readFilm().rgba, film.rgba);
}

TEST_P(ViewportRendererTest, DenoisingKeepsTheFilm) {
    view.denoise = true;
    live->setView(view, false);
    finish();
    const std::vector<std::uint32_t> denoised = shownPixels();
    EXPECT_EQ(live->readFilm().rgba, headless().rgba);
    Look look = view.look;
    live->setLook(look, false);
    finish();
    EXPECT_NE(shownPixels(), denoised);
    look.shown = SHOWN_NORMAL;
    live->setLook(look, false);
    finish();
    // the centre of the plastic ball faces the camera
    const std::uint32_t normal = shownPixels()[28 * 72 + 20];
    EXPECT_GT(normal & 255, 200u);
}

/// Black for misses, otherwise a colour per material; the first one is light red.
TEST_P(ViewportRendererTest, ShowsMaterials) {
    view.settings.first_hits = true;
    view.look.shown = SHOWN_MATERIAL;
    live->setView(view, false);
    finish();
    const std::vector<std::uint32_t> shown = shownPixels();
    const Film film = live->readFilm();
    std::map<std::uint32_t, std::uint32_t> colors;
    for (std::size_t i = 0; i < shown.size(); ++i)
        EXPECT_EQ(colors.try_emplace(film.material_id[i], shown[i]).first->second, shown[i]);
    EXPECT_EQ(colors.at(NO_INDEX), 0xFF000000u);
    EXPECT_EQ(colors.at(0) & 0xFFFF0000u, 0xFFFF0000u);
    EXPECT_NEAR(colors.at(0) & 255, 77, 1); // 0.3
    EXPECT_NE(colors.at(0), colors.at(1));
    EXPECT_EQ(film.material_id[28 * 72 + 20], 0u) << "plastic";
    EXPECT_EQ(film.material_id[28 * 72 + 52], 1u) << "glass";
}

TEST_P(ViewportRendererTest, DenoisesAtRest) {
    view.settings.first_hits = true;
    live->setView(view, false);
    finish();
    const std::vector<std::uint32_t> noisy = shownPixels();
    live->setLook(view.look, true);
    finish();
    EXPECT_NE(shownPixels(), noisy);
    live->setLook(view.look, false);
    finish();
    EXPECT_EQ(shownPixels(), noisy);
}

/// A preview is not a sample, even at full size.
TEST_P(ViewportRendererTest, PreviewsAreNotSamples) {
    view.settings.width = view.settings.height = 8;
    live->setView(view, true);
    live->work(kSlice_s);
    EXPECT_EQ(live->progress().size, (PixelSize{8, 8}));
    EXPECT_EQ(live->progress().samples, 0u);
    EXPECT_FALSE(live->isBetweenSamples());
}

/// The look may change at any time, even during a sample, without tracing again.
TEST_P(ViewportRendererTest, LookChangesKeepTheLight) {
    view.settings.first_hits = true;
    live->setView(view, false);
    Look look = view.look;
    for (int i = 0; i < 60; ++i) {
        live->work(kSlice_s / 4);
        look.exposure = 0.1f * static_cast<float>(i % 7);
        look.shown = i % 5 == 0 ? SHOWN_ALBEDO : SHOWN_BEAUTY;
        live->setLook(look, i % 3 == 0);
    }
    look.exposure = 1;
    look.shown = SHOWN_BEAUTY;
    for (const bool compresses : {true, false}) {
        look.compresses_highlights = compresses;
        live->setLook(look, false);
        finish();
        EXPECT_EQ(live->readFilm().rgba, headless().rgba);
        const Image8 developed = tonemapFilm(headless(), {1, compresses});
        const std::vector<std::uint32_t> words = shownPixels();
        for (std::size_t i = 0; i < words.size(); i += 7)
            ASSERT_NEAR(static_cast<int>(words[i] >> 16 & 255), developed.pixels[3 * i], 1) << i << compresses;
    }
}

INSTANTIATE_TEST_SUITE_P(Integrators, ViewportRendererTest,
                         testing::Values(Integrator::kPhong, Integrator::kWhitted, Integrator::kPath));

} // namespace
} // namespace pointrt
