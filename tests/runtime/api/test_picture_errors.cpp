// SPDX-License-Identifier: Apache-2.0
// Errors of pictures have the right kind and one line.
#include <gtest/gtest.h>

#include "pointrt/render.hpp"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {
namespace {

using Kind = TraceError::Kind;

template <typename Act>
void expectError(Kind kind, const std::string& part, const Act& act) {
    try {
        act();
        FAIL() << "no error: " << part;
    } catch (const TraceError& error) {
        EXPECT_EQ(error.kind, kind) << error.what();
        EXPECT_HAS(error.what(), part);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find("--"), std::string::npos) << error.what();
    }
}

class PictureErrors : public testing::Test {
protected:
    PictureErrors() { writeScan(folder.file("plane.pro"), planeSplats(8, 0.5f), {}); }
    PictureRenderer renderer(const PictureSettings& settings = {}) const {
        return PictureRenderer(device, {folder.file("plane.pro")}, settings);
    }
    TemporaryFolder folder;
    TraceDevice device;
};

TEST_F(PictureErrors, InvalidFilesAreNamed) {
    folder.write("text.pro", "no scan");
    folder.write("scene.toml", "x = 1\n");
    expectError(Kind::kBadUsage, "at least one", [&] { PictureRenderer(device, {}); });
    expectError(Kind::kBadInput, "missing.pro: ", [&] { PictureRenderer(device, {folder.file("missing.pro")}); });
    expectError(Kind::kBadInput, "text.pro: ", [&] { PictureRenderer(device, {folder.file("text.pro")}); });
    expectError(Kind::kBadInput, "scene.toml:1: ", [&] { PictureRenderer(device, {folder.file("scene.toml")}); });
    expectError(Kind::kBadUsage, "scene file *other", [&] {
        PictureRenderer(device, {folder.file("plane.pro"), folder.file("scene.toml")});
    });
}

TEST_F(PictureErrors, InvalidSettingsAreNamed) {
    const auto with = [&](const char* name, const char* text) {
        return [this, name, text] { renderer({{name, text}}); };
    };
    expectError(Kind::kBadUsage, "integrator: \"radiosity\" *phong", with("integrator", "radiosity"));
    expectError(Kind::kBadUsage, "spp: ", with("spp", "0"));
    expectError(Kind::kBadUsage, "staged_for: ", with("staged_for", "1,2"));
    expectError(Kind::kBadUsage, "up: ", with("up", "sideways"));
    // an object, which is not coloured by a value
    expectError(Kind::kBadUsage, "color_map: needs color_by", with("color_map", "turbo"));
    expectError(Kind::kBadUsage, "color_by: ", with("color_by", "reflectance"));
    expectError(Kind::kBadUsage, "size: unknown *known *integrator", with("size", "4x4"));
    expectError(Kind::kBadUsage, "exposure: unknown", with("exposure", "1"));
    expectError(Kind::kBadUsage, "output: unknown", with("output", "a.png"));
}

TEST_F(PictureErrors, InvalidPicturesAreRefused) {
    PictureRenderer one = renderer();
    const LookAt whole;
    expectError(Kind::kBadUsage, "0 x 5", [&] { one.render(whole, 0, 5, {"rgba"}); });
    expectError(Kind::kBadUsage, "5 x 16385", [&] { one.render(whole, 5, 16385, {"rgba"}); });
    expectError(Kind::kBadUsage, "unknown layer \"Depth\"*rgba, depth", [&] { one.render(whole, 5, 5, {"Depth"}); });
    expectError(Kind::kBadUsage, "no layer \"depth\"", [&] { one.render(whole, 5, 5, {"rgba"}).layer("depth"); });
    const std::array<double, 3> here{500064, 4500064, 200};
    expectError(Kind::kBadUsage, "eye *target", [&] { one.render(LookAt{here, here}, 5, 5, {"rgba"}); });
    expectError(Kind::kBadUsage, "fov: ", [&] { one.render(LookAt{.fov_deg = 180}, 5, 5, {"rgba"}); });
    PinholeCamera camera{5, 5, 2, 2};
    expectError(Kind::kBadUsage, "camera: *more than", [&] { one.render(camera, 5, 5, {"rgba"}); });
    camera.world_from_camera[0] = -1;
    expectError(Kind::kBadUsage, "camera: *mirrored", [&] { one.render(camera, 5, 5, {"rgba"}); });
    camera.world_from_camera[15] = 2;
    expectError(Kind::kBadUsage, "last row", [&] { one.render(camera, 5, 5, {"rgba"}); });
}

TEST_F(PictureErrors, RenderersAreUsableAfterCancellation) {
    PictureRenderer one = renderer({{"spp", "1000"}});
    int calls = 0;
    expectError(Kind::kCannotRun, "cancelled",
                [&] { one.render(LookAt{}, 64, 64, {"rgba"}, [&] { return ++calls > 3; }); });
    EXPECT_LT(calls, 100);
    const Picture picture = one.render(LookAt{}, 4, 4, {"samples"});
    EXPECT_EQ(picture.layer("samples").floats.at(15), 1000);
}

} // namespace
} // namespace pointrt::test
