// SPDX-License-Identifier: Apache-2.0
// Films may be continued years later, so their signatures must stay the same to the letter.
#include "runtime/render/film_signature.h"

#include <gtest/gtest.h>

#include "runtime/scene/camera.h"
#include "runtime/scene/render_setting_table.h"
#include "tests/support/says.h"

namespace pointrt {
namespace {

Camera testCamera() { return frameCamera({}, {-1, -1, -1}, {1, 1, 1}, 1); }

/// The part after the renderer's version and the scene's hash.
std::string settingsPart(const RenderSettings& settings, const Camera& camera) {
    const std::string signature = filmSignature({}, settings, camera, KernelForm::kWavefront);
    EXPECT_TRUE(signature.starts_with("renderer=")) << signature;
    return signature.substr(signature.find("; size="));
}

TEST(FilmSignature, OfDefaultsNeverChanges) {
    Camera camera = testCamera();
    camera.eye = {0.1, -2, 5};
    EXPECT_EQ(settingsPart({}, camera),
              "; size=512x512; camera=0.10000000000000001,-2,5 1,-0,0 0,1,0 0,0,-1 40; integrator=phong; bounces=4; "
              "seed=0; pixel=area; room=default; lights=default; shadows=on; blend=on; caustics=on; "
              "reflectivity=default");
}

TEST(FilmSignature, OfAllSettingsNeverChanges) {
    RenderSettings settings;
    settings.width = 30;
    settings.height = 20;
    settings.spp = 1;
    settings.seed = 4294967295;
    settings.integrator = Integrator::kDepth;
    settings.bounces = 64;
    settings.room = Room::kMatte;
    settings.lights = 16;
    settings.shadows = settings.caustics = settings.blend = false;
    settings.reflectivity = 0.1f;
    settings.denoise = DenoiseChoice::kOn;
    settings.exposure = 2;
    Camera camera = testCamera();
    camera.eye = {0, 0, 5};
    camera.ortho_height = 0.25;
    EXPECT_EQ(settingsPart(settings, camera),
              "; size=30x20; camera=0,0,5 1,-0,0 0,1,0 0,0,-1 ortho 0.25; integrator=depth; bounces=64; "
              "seed=4294967295; pixel=centre; room=matte; lights=16; shadows=off; blend=off; caustics=off; "
              "reflectivity=0.10000000149011612");
}

TEST(FilmSignature, ListsColourSettingsAfterOlderOnes) {
    RenderSettings settings;
    settings.color_by = "gps_time";
    settings.color_map = ColorMap::kTurbo;
    settings.color_range = {{0.1, 3e9}};
    settings.legend = true;
    const std::string before = settingsPart({}, testCamera());
    EXPECT_EQ(settingsPart(settings, testCamera()),
              before + "; color_by=gps_time; color_map=turbo; color_range=0.1,3e+09");
}

TEST(FilmSignature, ListsLitGaussians) {
    RenderSettings settings;
    settings.relight = true;
    EXPECT_EQ(settingsPart(settings, testCamera()), settingsPart({}, testCamera()) + "; relight=on");
}

TEST(FilmSignature, ListsAGivenBackground) {
    RenderSettings settings;
    settings.background = Background{{255, 128, 0}, false};
    const std::string before = settingsPart({}, testCamera());
    EXPECT_EQ(settingsPart(settings, testCamera()), before + "; background=#ff8000");
    settings.background = Background{{}, true};
    EXPECT_EQ(settingsPart(settings, testCamera()), before + "; background=transparent");
}

TEST(FilmSignature, ListsTheKernelFormLast) {
    const std::string queued = filmSignature({}, {}, testCamera(), KernelForm::kWavefront);
    const std::string fused = filmSignature({}, {}, testCamera(), KernelForm::kMegakernel);
    EXPECT_EQ(fused, queued + "; passes=fused") << "older films name no form and are wavefront";
    EXPECT_EQ(formOf(queued), KernelForm::kWavefront);
    EXPECT_EQ(formOf(fused), KernelForm::kMegakernel);
    EXPECT_EQ(formOf(""), KernelForm::kWavefront);
    EXPECT_SAYS(signatureDifference(fused, queued), "passes *fused *nothing");
}

std::uint32_t anotherValue(CountRange range, const std::optional<std::uint32_t>& value) {
    return value == range.low ? range.high : range.low;
}
float anotherValue(RealRange range, const std::optional<float>& value) {
    return static_cast<float>(value == static_cast<float>(range.low) ? range.high : range.low);
}
PixelSize anotherValue(SizeRange range, const std::optional<PixelSize>&) { return {1, range.longest}; }
std::string anotherValue(AttributeWord, const std::optional<std::string>&) { return "height"; }
ValueRange anotherValue(RangeOfValues, const std::optional<ValueRange>&) { return {2, 3}; }
Background anotherValue(BackgroundWord, const std::optional<Background>&) { return {}; }
template <typename Named>
Named anotherValue(OneOf<Named> choices, const std::optional<Named>& value) {
    return value == choices.names[0].value ? choices.names[1].value : choices.names[0].value;
}

TEST(FilmSignature, ListsTheSettingsMarkedInTheTable) {
    const RenderSettings before;
    forEachRenderSetting([&](const auto& row) {
        RenderChoices choices;
        choices.*row.choice = anotherValue(row.limits, settingOf(before, row.member));
        RenderSettings after = before;
        applyChoices(choices, after);
        const std::string difference =
            signatureDifference(filmSignature({}, before, testCamera(), KernelForm::kWavefront),
                                filmSignature({}, after, testCamera(), KernelForm::kWavefront));
        const std::string expected = row.film.place == 0 ? "" : std::string(row.film.name) + ' ';
        EXPECT_EQ(difference.substr(0, expected.size()), expected) << row.command_line.option;
        EXPECT_EQ(difference.empty(), row.film.place == 0) << row.command_line.option << ": " << difference;
    });
}

} // namespace
} // namespace pointrt
