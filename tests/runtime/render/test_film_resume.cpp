// SPDX-License-Identifier: Apache-2.0
// A film that is interrupted, saved and continued equals one rendered without a break; films of other scenes or
// settings are refused.
#include "runtime/render/film_resume.h"

#include <gtest/gtest.h>

#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "format/base/error.h"
#include "runtime/gpu/device.h"
#include "runtime/render/film_file.h"
#include "runtime/render/film_signature.h"
#include "runtime/render/loaded_scene.h"
#include "runtime/render/progressive_renderer.h"
#include "runtime/scene/camera.h"
#include "tests/support/ball_scene.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

namespace fs = std::filesystem;

RenderSettings testSettings() {
    RenderSettings settings;
    settings.width = settings.height = 24;
    settings.integrator = Integrator::kPath;
    settings.spp = 64;
    settings.first_hits = true;
    return settings;
}

class FilmResume : public DeviceFixture {
protected:
    void SetUp() override {
        load(testSettings(), {});
        camera = frameCamera({}, {-2, 0, -1}, {2, 2, 1}, 1);
    }
    void load(const RenderSettings& settings, FormRequest form) {
        LoadRequest request;
        request.scene = ballScene();
        request.settings = settings;
        request.form = form;
        loaded = loadScene(device, device, request, {});
    }
    std::string path() const { return folder.file("film.exr"); }
    std::string signature(const RenderSettings& settings) const {
        return filmSignature(loaded->scene, settings, camera, loaded->tracer.programs.form);
    }

    /// Continues the film start to this many samples in total.
    Film refine(const Film* start, std::uint32_t samples) {
        const RenderSettings& settings = loaded->settings;
        ProgressiveRenderer renderer(device, loaded->tracer);
        FrameJob job;
        job.samples = samples;
        renderer.begin({settings, camera, tilingFor(device, settings.width, settings.height)}, job,
                       start ? std::optional(*start) : std::nullopt);
        EXPECT_EQ(renderer.run().samples, samples);
        return renderer.takeFilm();
    }

    std::string refusal(const RenderSettings& settings) const {
        try {
            filmToResume(path(), signature(settings), settings);
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kBadInput);
            return error.what();
        }
        return "";
    }

    const test::TemporaryFolder folder;
    std::unique_ptr<LoadedScene> loaded;
    Camera camera;
};

/// Largest difference relative to the larger of the two, or to 1e-3.
double difference(const std::vector<float>& a, const std::vector<float>& b) {
    EXPECT_EQ(a.size(), b.size());
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] != b[i])
            worst = std::max(worst, std::abs(double{a[i]} - b[i]) / std::max({std::abs(a[i]), std::abs(b[i]), 1e-3f}));
    return worst;
}

TEST_F(FilmResume, ContinuesAsIfItHadNeverStopped) {
    const RenderSettings settings = testSettings();
    const Film whole = refine(nullptr, 64);
    for (const std::uint32_t first : {32u, 23u, 1u}) {
        writeSavedFilm(path(), {refine(nullptr, first), first, settings.seed, signature(settings)});
        const std::optional<Film> half = filmToResume(path(), signature(settings), settings);
        ASSERT_TRUE(half);
        EXPECT_EQ(mostSamples(*half), first);
        const Film film = refine(&*half, 64);
        EXPECT_LT(difference(film.rgba, whole.rgba), 2e-6) << first; // a single sum of floats, without 64 roundings
        EXPECT_LT(difference(film.indirect, whole.indirect), 2e-6) << first;
        EXPECT_LT(difference(film.variance, whole.variance), 1e-3) << first; // cancellation in differences
        EXPECT_EQ(film.depth, whole.depth);
        EXPECT_EQ(film.splat_id, whole.splat_id);
        EXPECT_EQ(film.material_id, whole.material_id);
        EXPECT_EQ(fewestSamples(film), 64u);
    }
    EXPECT_GT(difference(refine(nullptr, 32).rgba, whole.rgba), 1e-2) << "the second half must matter";
}

TEST_F(FilmResume, ContinuesInItsKernelForm) {
    EXPECT_FALSE(formToResume(path())) << "there is no film";
    RenderSettings settings = testSettings();
    settings.caustics = false; // their maps have one form only
    for (const KernelForm form : {KernelForm::kWavefront, KernelForm::kMegakernel}) {
        load(settings, form);
        const Film whole = refine(nullptr, 16);
        writeSavedFilm(path(), {refine(nullptr, 5), 5, settings.seed, signature(settings)});
        ASSERT_EQ(formToResume(path()), form);
        load(settings, form == KernelForm::kWavefront ? KernelForm::kMegakernel : KernelForm::kWavefront);
        EXPECT_HAS(refusal(settings), ": *passes ");
        load(settings, formToResume(path()));
        const std::optional<Film> start = filmToResume(path(), signature(settings), settings);
        const Film film = refine(&*start, 16);
        EXPECT_LT(difference(film.rgba, whole.rgba), 2e-6);
    }
}

TEST_F(FilmResume, TakesTheColoursFromTheLayers) {
    const RenderSettings settings = testSettings();
    Film film = refine(nullptr, 8);
    const std::vector<float> rgba = film.rgba;
    for (std::size_t i = 0; i < film.rgba.size(); i += 4) film.rgba[i] = 0.5f; // as after a denoiser
    writeSavedFilm(path(), {film, 8, settings.seed, signature(settings)});
    EXPECT_LT(difference(filmToResume(path(), signature(settings), settings)->rgba, rgba), 1e-6);
}

TEST_F(FilmResume, StartsIfThereIsNoFile) { EXPECT_FALSE(filmToResume(path(), "", testSettings())); }

TEST_F(FilmResume, NamesTheSettingThatDiffers) {
    const RenderSettings settings = testSettings();
    writeSavedFilm(path(), {refine(nullptr, 2), 2, settings.seed, signature(settings)});
    EXPECT_EQ(refusal(settings), "");
    RenderSettings other = settings;
    other.spp = 1000; // the number of samples may differ
    EXPECT_EQ(refusal(other), "");
    other.seed = 5;
    EXPECT_SAYS(refusal(other), path() + ": *seed *0 *5");
    other = settings;
    other.integrator = Integrator::kWhitted;
    EXPECT_SAYS(refusal(other), path() + ": *integrator *path *whitted");
    other = settings;
    other.width = 25;
    EXPECT_SAYS(refusal(other), path() + ": *size *24x24 *25x24");
    other = settings;
    other.spp = 1;
    EXPECT_SAYS(refusal(other), path() + ": *pixel *area *centre");
    camera.eye.x += 1e-9;
    EXPECT_HAS(refusal(settings), ": *camera ");
    camera.eye.x -= 1e-9;
    camera.ortho_height = 4;
    EXPECT_HAS(refusal(settings), ": *camera ");
    writeSavedFilm(path(), {refine(nullptr, 2), 2, settings.seed, signature(settings)});
    EXPECT_EQ(refusal(settings), "");
    camera.fov_deg += 1; // has no effect on a parallel projection
    EXPECT_EQ(refusal(settings), "");
    camera.ortho_height = 4.5;
    EXPECT_HAS(refusal(settings), ": *camera *ortho 4.5");
}

TEST_F(FilmResume, RefusesIncompleteFilms) {
    const RenderSettings settings = testSettings();
    const Film film = refine(nullptr, 2);
    const auto save = [&](auto damage) {
        Film copy = film;
        damage(copy);
        writeSavedFilm(path(), {copy, 2, settings.seed, signature(settings)});
    };
    save([](Film& copy) { copy.caustic.clear(); });
    EXPECT_HAS(refusal(settings), "no channel caustic.R");
    save([](Film& copy) { copy.samples[30] = 3; });
    EXPECT_HAS(refusal(settings), "channel samples *damaged");
    save([](Film& copy) { copy.samples.assign(copy.samples.size(), 1e9f); });
    EXPECT_HAS(refusal(settings), "channel samples *damaged");
}

TEST(SignatureDifference, NamesTheFirstSettingThatDiffers) {
    EXPECT_EQ(signatureDifference("a=1; b=2", "a=1; b=2"), "");
    EXPECT_SAYS(signatureDifference("a=1; b=2; c=3", "a=1; b=4; c=5"), "b *2 *4");
    EXPECT_SAYS(signatureDifference("a=1", "a=1; b=2"), "b *nothing *2");
    EXPECT_SAYS(signatureDifference("a=1; b=2", "a=1"), "b *2 *nothing");
    EXPECT_SAYS(signatureDifference("junk", "a=1"), "a *nothing *1");
}

} // namespace
} // namespace pointrt
