// SPDX-License-Identifier: Apache-2.0
// Scans with colours and materials by attributes, under a sky of radiance 1, so that pictures show reflectances.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "pointrt/pro.hpp"
#include "runtime/scene/point_classes.h"
#include "tests/support/splat_scenes.h"
#include "tests/trace/render_helper.h"

namespace pointrt::test {
namespace {

/// A unit sphere of class 6 in its upper half and class 2 in its lower half. Splats are red; their material halves
/// that.
struct ClassSphere {
    ClassSphere() {
        const std::string bare = temporaryPath("bare.pro");
        Splats splats = sphereSplats(4000, Vec3f(0, 0, 0), 1.0f);
        paint(splats, {255, 0, 0});
        BuildOptions options;
        options.materials = {matteRow(0.5f, 0.5f, 0.5f)};
        writeScene(bare, std::move(splats), options);
        {
            const ProFile file(bare);
            std::vector<std::uint8_t> classes;
            for (std::size_t i = 0; i < file.info().splat_count; ++i)
                classes.push_back(file.splat(i).position[1] > 0.5f ? 6 : 2);
            pro_attribute attribute{"classification", PRO_TYPE_U8, 1, 0, 0, classes.data()};
            const pro_content content{&file.info(), &file.view(), file.index(), nullptr, &attribute, 1, nullptr};
            EXPECT_EQ(pro_write_content(path.c_str(), &content, 1, nullptr), PRO_OK);
        }
        std::remove(bare.c_str());
    }
    ~ClassSphere() { std::remove(path.c_str()); }
    ClassSphere(const ClassSphere&) = delete;
    std::string path = temporaryPath("classes.pro");
};

double linear(std::uint8_t byte) {
    const double x = byte / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

/// With paths of one bounce under a sky of radiance 1, pixels have the reflectance.
RenderSettings furnace() {
    RenderSettings settings = square(32);
    settings.integrator = Integrator::kPath;
    settings.spp = 16;
    settings.seed = 3;
    settings.lights = 0;
    return settings;
}

SceneDescription underSky(const std::string& path) {
    SceneDescription scene;
    scene.instances.push_back({path, {}, {}, {}});
    scene.sky = evenSky(1);
    return scene;
}

void expectColor(const Film& film, std::uint32_t y, Srgb8 expected) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel(film, 16, y, c), linear(expected[static_cast<std::size_t>(c)]), 0.02) << y << " " << c;
}

TEST(Colors, ClassColoursAreReflectances) {
    const ClassSphere sphere;
    RenderSettings settings = furnace();
    settings.color_by = "class";
    const Rendered rendered = renderScene(underSky(sphere.path), settings);
    expectColor(rendered.film, 10, classColor(6));
    expectColor(rendered.film, 22, classColor(2));
    settings.color_by = kOwnColors;
    const Rendered plain = renderScene(underSky(sphere.path), settings);
    EXPECT_NEAR(pixel(plain.film, 16, 10, 0), 0.5, 0.02) << "the file's material applies again";
    EXPECT_NEAR(pixel(plain.film, 16, 10, 1), 0, 0.02);
}

TEST(Colors, OverridesByClassGiveOtherMaterials) {
    const ClassSphere sphere;
    SceneDescription scene = underSky(sphere.path);
    scene.materials.resize(2);
    scene.materials[0].color = {0, 0, 0};
    scene.materials[0].emission = {2, 3, 4};
    scene.materials[1].color = {0.25f, 0.25f, 0.25f};
    scene.instances[0].overrides = {{SplatSelection{"class", {{6, 6}}}, 0, ""},
                                    {SplatSelection{"height", {{-2, -0.2}}}, 1, ""}};
    const Rendered rendered = renderScene(scene, furnace());
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel(rendered.film, 16, 10, c), 2 + c, 0.02);
    EXPECT_NEAR(pixel(rendered.film, 16, 21, 1), 0.25, 0.02);
    // the table: the scene's two materials, the file's row, a row for each material of the overrides
    EXPECT_EQ(rendered.film.material_id[10 * 32 + 16], 3u);
    EXPECT_EQ(rendered.film.material_id[21 * 32 + 16], 4u);
}

/// Two instances of a file, each with its own paint.
TEST(Colors, HeightColoursFollowEachInstance) {
    const ClassSphere sphere;
    SceneDescription scene = underSky(sphere.path);
    scene.instances[0].placement.translation = {-1.5, 0, 0};
    scene.instances.push_back({sphere.path, {}, {}, {}});
    scene.instances[1].placement.translation = {1.5, 4, 0};
    RenderSettings settings = furnace();
    settings.color_by = "height";
    settings.color_map = ColorMap::kGrey;
    settings.color_range = {{-1, 5}};
    settings.camera.target = Vec3{-1.5, 0, 0};
    settings.camera.eye = Vec3{-1.5, 0, 6};
    settings.camera.fov_deg = 10;
    const Rendered low = renderScene(scene, settings);
    settings.camera.target = Vec3{1.5, 4, 0};
    settings.camera.eye = Vec3{1.5, 4, 6};
    const Rendered high = renderScene(scene, settings);
    EXPECT_NEAR(pixel(low.film, 16, 16, 0), linear(43), 0.03);   // a sixth of the range
    EXPECT_NEAR(pixel(high.film, 16, 16, 0), linear(213), 0.03); // five sixths
}

} // namespace
} // namespace pointrt::test
