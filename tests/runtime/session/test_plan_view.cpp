// SPDX-License-Identifier: Apache-2.0
// The camera and place of plans of a known scan.
#include "runtime/session/plan_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "format/base/error.h"
#include "runtime/session/settings.h"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {
namespace {

/// A plane with splat centres from 15.36 to 112.64 m in a cube at (500000, 4500000, 100).
class PlanView : public testing::Test {
protected:
    PlanView() {
        test::writeScan(folder.file("plane.pro"), test::planeSplats(20, 0.5f), {});
        options.scene = folder.file("plane.pro");
        options.output = "plan.png";
    }

    void fill() {
        SceneDescription scene = describeScene(options);
        fillPlan(options, scene);
    }

    std::string refusal() {
        try {
            fill();
        } catch (const Error& error) {
            EXPECT_EQ(error.code, ExitCode::kBadUsage);
            return error.what();
        }
        return "";
    }

    const test::TemporaryFolder folder;
    Options options;
};

TEST_F(PlanView, CoversTheScanOnMultiplesOfThePixel) {
    options.plan = 0.3;
    fill();
    const GeoReference& place = *options.place;
    EXPECT_EQ(place.pixel, 0.3);
    for (const double edge : {place.west, place.north}) EXPECT_NEAR(edge / 0.3, std::round(edge / 0.3), 1e-6);
    EXPECT_LE(place.west, 500015.36);
    EXPECT_GT(place.west, 500015.36 - 0.3);
    const auto size = *options.choices.size;
    EXPECT_GE(place.west + 0.3 * size.width, 500112.64 - 1e-3);
    EXPECT_GE(4500015.36 + 1e-3, place.north - 0.3 * size.height);
    EXPECT_GE(place.north, 4500112.64 - 1e-3);
    EXPECT_NEAR(*options.camera.ortho_height, 0.3 * size.height, 1e-9);
    EXPECT_NEAR(options.camera.eye->x, place.west + 0.15 * size.width, 1e-6);
    EXPECT_NEAR(options.camera.eye->y, place.north - 0.15 * size.height, 1e-6);
    EXPECT_GT(options.camera.eye->z, 164);
    EXPECT_TRUE(options.choices.background->transparent);
    EXPECT_EQ(options.up_axis, (Vec3{0, 0, 1})) << "heights are along z, north is only up in the picture";
}

TEST_F(PlanView, ShowsAPartAroundATarget) {
    options.plan = 0.5;
    options.choices.size = PixelSize{101, 50};
    options.camera.target = Vec3{500050, 4500060, 0};
    fill();
    EXPECT_EQ(*options.choices.size, (PixelSize{101, 50}));
    EXPECT_NEAR(options.place->west + 0.5 * 50.5, 500050, 0.26);
    EXPECT_NEAR(options.place->north - 0.5 * 25, 4500060, 0.26);
}

TEST_F(PlanView, RefusesWhatIsNoPlan) {
    options.plan = 1e-4;
    EXPECT_NE(refusal().find("16384"), std::string::npos);
    options.plan = 1;
    folder.write("tilted.toml", "up = [1, 0, 1]\n[[instance]]\nfile = \"plane.pro\"\n");
    options.scene = folder.file("tilted.toml");
    EXPECT_NE(refusal().find("axis"), std::string::npos);
    folder.write("empty.toml", "[[instance]]\nfile = \"plane.pro\"\nvisible = false\n");
    options.scene = folder.file("empty.toml");
    EXPECT_NE(refusal().find("no visible scan"), std::string::npos);
}

/// A plane of 97.28 m, and beside it one of half the size, turned a quarter to the left about the origin of the map.
TEST_F(PlanView, CoversAllVisibleScansOfAScene) {
    folder.write("scene.toml", "[[instance]]\nfile = \"plane.pro\"\n"
                               "[[instance]]\nfile = \"plane.pro\"\nscale = 0.5\n"
                               "rotate = [{axis = [0, 0, 1], degrees = 90}]\n"
                               "[[instance]]\nfile = \"plane.pro\"\nscale = 100\nvisible = false\n");
    options.scene = folder.file("scene.toml");
    options.plan = 1000;
    fill();
    const GeoReference& place = *options.place;
    EXPECT_EQ(place.west, std::floor(-4500112.64 / 2 / 1000) * 1000);
    EXPECT_EQ(place.north, std::ceil(4500112.64 / 1000) * 1000);
    const auto size = *options.choices.size;
    EXPECT_EQ(place.west + 1000 * size.width, std::ceil(500112.64 / 1000) * 1000);
    EXPECT_EQ(place.north - 1000 * size.height, std::floor(500015.36 / 2 / 1000) * 1000);
    EXPECT_EQ(place.epsg, 0) << "the second one is not where its file says";
}

/// With y up, x is east and -z is north, as in a picture from above.
TEST_F(PlanView, LooksAlongAnyAxis) {
    folder.write("scene.toml", "up = \"y\"\n[[instance]]\nfile = \"plane.pro\"\n");
    options.scene = folder.file("scene.toml");
    options.plan = 0.5;
    fill();
    EXPECT_EQ(options.up_axis, (Vec3{0, 1, 0}));
    EXPECT_EQ(options.camera.up, (Vec3{0, 0, -1}));
    EXPECT_EQ(options.camera.eye->x, options.camera.target->x);
    EXPECT_EQ(options.camera.eye->z, options.camera.target->z);
    EXPECT_GT(options.camera.eye->y, 4500112);
    EXPECT_EQ(options.place->west, 500015);
    EXPECT_NEAR(options.place->north, -options.camera.target->z, 0.5) << "one row of pixels: the plane is level";
    folder.write("x.toml", "up = \"-x\"\n[[instance]]\nfile = \"plane.pro\"\n");
    options = {};
    options.output = "plan.png";
    options.scene = folder.file("x.toml");
    options.plan = 0.5;
    fill();
    EXPECT_EQ(options.camera.up, (Vec3{0, 0, -1})) << "north is up x east, and east is y";
    EXPECT_LT(options.camera.eye->x, 500015);
    EXPECT_EQ(options.place->west, 4500015);
}

} // namespace
} // namespace pointrt
