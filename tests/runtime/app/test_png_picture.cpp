// SPDX-License-Identifier: Apache-2.0
// The pixels of PNGs of pointrt-view, read back by libpng.
#include "runtime/app/png_picture.h"

#include <gtest/gtest.h>

#include <png.h>

#include "tests/support/temporary_folder.h"
#include "tests/support/validated_device.h"

namespace pointrt {
namespace {

using PngBytes = std::vector<std::uint8_t>;

PngBytes pixelsOf(const std::string& path, png_uint_32 format) {
    png_image read{};
    read.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_file(&read, path.c_str())) << read.message;
    EXPECT_EQ(read.format, format);
    PngBytes pixels(PNG_IMAGE_SIZE(read));
    EXPECT_TRUE(png_image_finish_read(&read, nullptr, pixels.data(), 0, nullptr)) << read.message;
    return pixels;
}

/// A row of four pixels without noise: covered, half, not at all, and covered brightly.
Film fourPixels() {
    Film film;
    film.width = 4;
    film.height = 1;
    film.rgba = {0.5f, 0, 1, 1, 0.25f, 0, 0.5f, 0.5f, 0, 0, 0, 0, 0.9f, 2, 0, 1};
    film.depth.assign(4, 1);
    film.normal = {0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    film.albedo.assign(12, 1);
    film.variance.assign(4, 0);
    return film;
}

class PngPictureTest : public DeviceFixture {
protected:
    /// The pixels of a picture of two rows, the second of which is missing.
    PngBytes written(const ToneMapping& tone, bool filtered, png_uint_32 format) {
        const PixelSize size{4, 2};
        PngPlan plan{folder.file("a.png"), size, tone, {}, {}, Writing::kWhole};
        if (filtered) plan.filter = {size, true, !tone.has_alpha, filterTileFor(size)};
        PngPicture picture(device, plan);
        picture.addRows(fourPixels(), 0, 1);
        picture.finish();
        return pixelsOf(folder.file("a.png"), format);
    }

    const test::TemporaryFolder folder;
};

TEST_F(PngPictureTest, HasTheCoverageAsStraightAlpha) {
    const PngBytes expected = {188, 0, 255, 255, 188, 0, 255, 128, 0, 0, 0, 0, 243, 255, 0, 255, //
                               0,   0, 0,   0,   0,   0, 0,   0,   0, 0, 0, 0, 0,   0,   0, 0};
    for (const bool filtered : {false, true})
        EXPECT_EQ(written({0, false, true}, filtered, PNG_FORMAT_RGBA), expected) << filtered;
}

TEST_F(PngPictureTest, HasNoAlphaOtherwise) {
    const PngBytes expected = {188, 0, 255, 137, 0, 188, 0, 0, 0, 243, 255, 0, //
                               0,   0, 0,   0,   0, 0,   0, 0, 0, 0,   0,   0};
    for (const bool filtered : {false, true})
        EXPECT_EQ(written({0, false}, filtered, PNG_FORMAT_RGB), expected) << filtered;
}

} // namespace
} // namespace pointrt
