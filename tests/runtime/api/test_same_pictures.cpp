// SPDX-License-Identifier: Apache-2.0
// Pictures in memory are bit-identical to the OpenEXR files of pointrt-view.
#include <algorithm>
#include <span>

#include "tests/runtime/api/same_pictures.h"
#include "tests/runtime/rays/ray_scenes.h"

namespace pointrt::test {
namespace {

/// A ball and a plane in the UTM coordinates of ray_scenes.h.
class SamePictures : public PictureFolder {
protected:
    SamePictures() {
        writeScan(folder.file("plane.pro"), planeSplats(20, 0.2f), {});
        writeScan(folder.file("ball.pro"), sphereSplats(1500, 0.3f), {});
    }
};

TEST_F(SamePictures, WithDefaults) {
    expectSame(rendered({"ball.pro"}, {}, LookAt{}, 60, 60), viewed("ball.pro --size 60x60"));
}

TEST_F(SamePictures, WithACameraAndSettings) {
    LookAt camera;
    camera.eye = {500100, 4500010, 220};
    camera.target = {500064, 4500064, 150};
    camera.up = {0, 0, 1};
    camera.fov_deg = 50;
    expectSame(rendered({"ball.pro"},
                        {{"integrator", "path"},
                         {"spp", "3"},
                         {"seed", "7"},
                         {"bounces", "3"},
                         {"up", "z"},
                         {"staged-for", "500100,4500010,220"}},
                        camera, 64, 48),
               viewed("ball.pro --eye 500100,4500010,220 --target 500064,4500064,150 --up z --fov 50 --size 64x48 "
                      "--integrator path --spp 3 --seed 7 --bounces 3"));
}

TEST_F(SamePictures, OfASceneFileWithGlassAndSun) {
    folder.write(
        "scene.toml",
        "up = \"z\"\n[camera]\neye = [500150, 4500010, 260]\nfov = 45\n"
        "[material.clear]\nkind = \"glass\"\n[[light]]\ntype = \"sun\"\ntowards = [1, 2, 3]\nirradiance = [3, 3, 3]\n"
        "[[instance]]\nfile = \"plane.pro\"\n[[instance]]\nfile = \"ball.pro\"\nmaterial = "
        "\"clear\"\n");
    expectSame(rendered({"scene.toml"}, {{"integrator", "whitted"}, {"spp", "2"}}, LookAt{}, 48, 48),
               viewed("scene.toml --integrator whitted --spp 2 --size 48x48"));
}

TEST_F(SamePictures, InSeveralBands) {
    // a band has at most 2^19 pixels
    expectSame(rendered({"plane.pro"}, {{"spp", "4"}, {"shadows", "off"}, {"lights", "1"}}, LookAt{}, 1024, 600),
               viewed("plane.pro --size 1024x600 --spp 4 --shadows off --lights 1"));
}

TEST_F(SamePictures, AfterOtherPictures) {
    PictureRenderer several(device, {folder.file("ball.pro")}, {{"spp", "2"}});
    const LookAt whole;
    PinholeCamera aside{30, 40, 10, 50, {1, 0, 0, 500064, 0, -1, 0, 4500064, 0, 0, -1, 290, 0, 0, 0, 1}};
    const Picture before = several.render(whole, 40, 30, allLayers());
    several.render(aside, 700, 800, {"rgba"}); // needs a larger film
    several.render(aside, 5, 3, {"depth"});
    const Picture after = several.render(whole, 40, 30, allLayers());
    ASSERT_EQ(before.layers.size(), after.layers.size());
    for (std::size_t i = 0; i < before.layers.size(); ++i) {
        EXPECT_TRUE(std::ranges::equal(std::as_bytes(std::span(before.layers[i].floats)),
                                       std::as_bytes(std::span(after.layers[i].floats))));
        EXPECT_EQ(before.layers[i].words, after.layers[i].words);
    }
}

} // namespace
} // namespace pointrt::test
