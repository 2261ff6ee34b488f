// SPDX-License-Identifier: Apache-2.0
// The files that pointrt-view --cameras writes.
#include <gtest/gtest.h>

#include <png.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>

#include "pointrt/render.hpp"
#include "runtime/app/camera_pictures.h"
#include "runtime/image/exr_read.h"
#include "runtime/scene_io/camera_list.h"
#include "tests/runtime/api/camera_lists.h"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/says.h"

namespace pointrt::test {
namespace {

/// The samples of a PNG as stored.
struct PngNumbers {
    std::uint32_t width = 0, height = 0, channels = 0, bits = 0;
    std::vector<std::uint32_t> values;
};

PngNumbers readPng(const std::string& path) {
    PngNumbers numbers;
    std::FILE* const file = std::fopen(path.c_str(), "rb");
    EXPECT_NE(file, nullptr) << path;
    if (!file) return numbers;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    numbers = {png_get_image_width(png, info),
               png_get_image_height(png, info),
               png_get_channels(png, info),
               png_get_bit_depth(png, info),
               {}};
    const std::size_t row = std::size_t{numbers.width} * numbers.channels;
    for (std::uint32_t y = 0; y < numbers.height; ++y) {
        const png_bytep at = png_get_rows(png, info)[y];
        for (std::size_t i = 0; i < row; ++i)
            numbers.values.push_back(numbers.bits == 16 ? at[2 * i] * 256u + at[2 * i + 1] : at[i]);
    }
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(file);
    return numbers;
}

/// plane.pro is level, 102 m square around (500064, 4500064, 164). The cameras look straight down on it from 36 m
/// above, north up; the principal point of the second picture is off centre.
class CameraSets : public testing::Test {
protected:
    CameraSets() {
        writeScan(folder.file("plane.pro"), planeSplats(30, 0.5f), {});
        const std::string pose = "[[1, 0, 0, 500064], [0, 1, 0, 4500064], [0, 0, 1, 200], [0, 0, 0, 1]]";
        folder.write("list.json", R"({"fl_x": 50, "w": 40, "h": 30, "frames": [{"file_path": "in/a.jpg",
            "transform_matrix": )" + pose +
                                      R"(}, {"file_path": "in/more/b.jpg", "w": 32, "h": 20, "cx": 3.5, "fl_y": 40,
            "transform_matrix": )" + pose +
                                      "}]}");
    }

    int run(const std::string& words) const {
        const std::string command =
            "cd '" + folder.path.string() + "' && '" POINTRT_VIEW "' plane.pro " + words + " >.out 2>.err";
        return WEXITSTATUS(std::system(command.c_str()));
    }
    std::string text(const std::string& name) const {
        std::ifstream file(folder.file(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void expectRefused(int code, const std::string& part, const std::string& words) const {
        EXPECT_EQ(run(words), code) << words;
        EXPECT_HAS(text(".err"), part);
        EXPECT_FALSE(std::filesystem::exists(folder.file("set/transforms.json")));
    }

    TemporaryFolder folder;
};

TEST_F(CameraSets, ContainTheSelectedLayers) {
    ASSERT_EQ(
        run("-q --cameras list.json -o set --spp 1 --layers rgb,albedo,depth,normal,instance,exr --depth-unit 0.001"),
        0)
        << text(".err");
    for (const char* name : {"a", "more/b"}) {
        const std::size_t pixels = std::string(name) == "a" ? 1200 : 640;
        const PngNumbers depth = readPng(folder.file(std::string("set/depth/") + name + ".png"));
        EXPECT_EQ(depth.channels, 1u);
        EXPECT_EQ(depth.bits, 16u);
        ASSERT_EQ(depth.values.size(), pixels);
        // depth is measured along the axis, so it is equal in all pixels: 36 m in millimetres
        for (const std::uint32_t value : depth.values) ASSERT_NEAR(value, 36000, 1.1);
        const PngNumbers normal = readPng(folder.file(std::string("set/normal/") + name + ".png"));
        ASSERT_EQ(normal.values.size(), 3 * pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            ASSERT_NEAR(normal.values[3 * i], 127.5, 1.1);
            ASSERT_NEAR(normal.values[3 * i + 2], 255, 1.1);
        }
        for (const std::uint32_t value : readPng(folder.file(std::string("set/instance/") + name + ".png")).values)
            ASSERT_EQ(value, 1u);
        for (const std::uint32_t value : readPng(folder.file(std::string("set/albedo/") + name + ".png")).values)
            ASSERT_NEAR(value, 200, 1); // the colour of splats in ray_scenes.h
        EXPECT_EQ(readPng(folder.file(std::string("set/rgb/") + name + ".png")).channels, 3u);
    }
}

TEST_F(CameraSets, FilmsAgreeWithTheLibrary) {
    ASSERT_EQ(run("-q --cameras list.json -o set --spp 2 --layers exr"), 0) << text(".err");
    const ExrPicture film = readExr(folder.file("set/exr/more/b.exr"), ExrKind::kFilm);
    const TraceDevice device;
    PictureRenderer renderer(device, {folder.file("plane.pro")}, {{"spp", "2"}});
    const PinholeCamera camera{50, 40, 3.5, 10, {1, 0, 0, 500064, 0, -1, 0, 4500064, 0, 0, -1, 200, 0, 0, 0, 1}};
    const Picture picture = renderer.render(camera, 32, 20, {"depth", "splat_id", "albedo"});
    const auto depth = film.floats.at("Z"), red = film.floats.at("albedo.R");
    const auto ids = film.words.at("id.splat");
    for (std::size_t i = 0; i < 640; ++i) {
        ASSERT_EQ(depth[i], picture.layer("depth").floats[i]) << i;
        ASSERT_EQ(red[i], picture.layer("albedo").floats[3 * i]) << i;
        ASSERT_EQ(ids[i], picture.layer("splat_id").words[i]) << i;
    }
}

TEST_F(CameraSets, TheWrittenListReproducesThePictures) {
    ASSERT_EQ(run("-q --cameras list.json -o set --spp 2"), 0) << text(".err");
    ASSERT_EQ(run("-q --cameras set -o again --spp 2"), 0) << text(".err");
    EXPECT_EQ(text("set/transforms.json"), text("again/transforms.json"));
    for (const char* file : {"rgb/a.png", "depth/a.png", "normal/more/b.png", "exr/more/b.exr"}) {
        EXPECT_FALSE(text(std::string("set/") + file).empty()) << file;
        EXPECT_EQ(text(std::string("set/") + file), text(std::string("again/") + file)) << file;
    }
    const std::string list = text("set/transforms.json");
    EXPECT_NE(list.find("\"file_path\": \"rgb/more/b.png\""), std::string::npos) << list;
    EXPECT_NE(list.find("\"depth_file_path\": \"depth/a.png\""), std::string::npos) << list;
    EXPECT_NE(list.find("\"depth_unit_scale_factor\": 0.01"), std::string::npos) << list; // 120 m exceed 65535 mm
    EXPECT_NE(list.find("-4500064.0"), std::string::npos) << list;
}

TEST_F(CameraSets, RefuseInvalidOptions) {
    folder.write("far.json", R"({"fl_x": 50, "w": 40, "h": 30, "frames": [{"file_path": "a",
        "transform_matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}]})");
    folder.write("bent.json", R"({"fl_x": 50, "w": 40, "h": 30, "k1": 0.1, "frames": [{"file_path": "a",
        "transform_matrix": [[1, 0, 0, 500064], [0, 1, 0, 4500064], [0, 0, 1, 200], [0, 0, 0, 1]]}]})");
    expectRefused(1, "none.json: No such file", "--cameras none.json -o set");
    expectRefused(1, "far.json: frame 0: *10000", "--cameras far.json -o set");
    expectRefused(1, "bent.json: frame 0: *distortion (k1 0.1)", "--cameras bent.json -o set");
    expectRefused(2, "--cameras: *FOLDER", "--cameras list.json");
    expectRefused(2, "--cameras *--eye *combined", "--cameras list.json -o set --eye 1,2,3");
    expectRefused(2, "--cameras *--turntable *combined", "--cameras list.json -o set --turntable 3");
    expectRefused(2, "--layers: \"deph\" *rgb, albedo", "--cameras list.json -o set --layers rgb,deph");
    expectRefused(2, "--size: ", "--cameras list.json -o set --size 40x31");
    expectRefused(2, "need --cameras", "-o a.png --layers rgb");
    expectRefused(4, "list.json/set", "--cameras list.json -o list.json/set");
    EXPECT_EQ(run("--cameras bent.json -o set --distortion drop --spp 1 --layers depth"), 0) << text(".err");
    EXPECT_HAS(text(".err"), "1 of 1 *distortion");
    EXPECT_EQ(run("--cameras set -o set"), 2);
    EXPECT_HAS(text(".err"), "overwrite");
}

TEST(DepthNumbers, AreAlongTheAxis) {
    const PinholeLens lens{10, 10, 0.5, 0.5};
    EXPECT_EQ(depthNumber(2.0f, lens, 0, 0, 0.001), 2000);
    EXPECT_EQ(depthNumber(std::sqrt(2.0f), lens, 10, 0, 0.001), 1000); // 45 degrees off the axis
    EXPECT_EQ(depthNumber(65.535f, lens, 0, 0, 0.001), 65535);
    EXPECT_EQ(depthNumber(65.536f, lens, 0, 0, 0.001), 0);
    EXPECT_EQ(depthNumber(INFINITY, lens, 0, 0, 0.001), 0);
}

} // namespace
} // namespace pointrt::test
