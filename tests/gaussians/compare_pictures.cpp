// SPDX-License-Identifier: Apache-2.0
// compare_pictures A B: how much two pictures differ, display-encoded. PFM files are taken as they are, linear EXR
// files are encoded, and with a PNG the values of both are limited to 0 to 1.
#include <png.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "format/base/run_tool.h"
#include "runtime/image/exr_read.h"
#include "runtime/image/tonemap.h"
#include "tests/gaussians/picture_difference.h"
#include "tests/gaussians/srgb.h"

namespace pointrt::test {

namespace {

struct Request {
    std::string a, b;
    double least_psnr_db = -INFINITY;
    bool tone_maps = false;
};

std::string suffixOf(const std::string& path) {
    const std::size_t dot = path.rfind('.');
    return dot == std::string::npos ? "" : path.substr(dot);
}

FloatPicture readPng(const std::string& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    const auto fail = [&] { return Error(ExitCode::kBadInput, path + ": " + image.message); };
    if (!png_image_begin_read_from_file(&image, path.c_str())) throw fail();
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
    const png_color black{0, 0, 0};
    if (!png_image_finish_read(&image, &black, bytes.data(), 0, nullptr)) throw fail();
    FloatPicture picture{image.width, image.height, 3, {}};
    for (const std::uint8_t byte : bytes) picture.values.push_back(static_cast<float>(byte) / 255);
    return picture;
}

FloatPicture readLinearExr(const std::string& path) {
    const ExrPicture exr = readExr(path, ExrKind::kFilm);
    FloatPicture picture{exr.width, exr.height, 3, {}};
    picture.values.resize(std::size_t{3} * exr.width * exr.height);
    std::size_t channel = 0;
    for (const char* name : {"R", "G", "B"}) {
        const auto plane = exr.floats.find(name);
        if (plane == exr.floats.end()) throw Error(ExitCode::kBadInput, path + ": has no channel " + name);
        for (std::size_t i = 0; i < plane->second.size(); ++i)
            picture.values[3 * i + channel] = static_cast<float>(srgbFromLinear(plane->second[i]));
        ++channel;
    }
    return picture;
}

FloatPicture readPicture(const std::string& path) {
    const std::string suffix = suffixOf(path);
    if (suffix == ".pfm") return readPfm(path);
    if (suffix == ".png") return readPng(path);
    if (suffix == ".exr") return readLinearExr(path);
    throw Error(ExitCode::kBadUsage, path + ": must be a .pfm, .png or .exr");
}

/// Compresses highlights as pointrt-view does in PNG files.
void toneMapPicture(FloatPicture& picture) {
    for (std::size_t i = 0; i + 2 < picture.values.size(); i += 3) {
        float* const rgb = &picture.values[i];
        const auto linear = [&](int c) { return static_cast<float>(linearFromSrgb(rgb[c])); };
        const std::array<float, 3> mapped = toneMap({linear(0), linear(1), linear(2)});
        for (std::size_t c = 0; c < 3; ++c) rgb[c] = static_cast<float>(srgbFromLinear(mapped[c]));
    }
}

void limit(FloatPicture& picture) {
    for (float& value : picture.values) value = std::clamp(value, 0.0f, 1.0f);
}

int compare(const Request& request) {
    FloatPicture a = readPicture(request.a), b = readPicture(request.b);
    if (request.tone_maps) toneMapPicture(a);
    if (suffixOf(request.a) == ".png" || suffixOf(request.b) == ".png") {
        limit(a);
        limit(b);
    }
    const PictureDifference difference = differenceOf(a, b);
    std::printf("psnr_db %.2f\nmax_difference %.6f\nshare_off %.6f\n", difference.psnr_db, difference.max_difference,
                difference.share_off);
    return difference.psnr_db >= request.least_psnr_db ? 0 : static_cast<int>(ExitCode::kBadInput);
}

} // namespace

} // namespace pointrt::test

int main(int argc, char** argv) {
    using namespace pointrt;
    CLI::App app("Compares two pictures, display-encoded.", "compare_pictures");
    test::Request request;
    app.add_option("A", request.a, "A .pfm (display-encoded), .exr (linear) or .png")->required();
    app.add_option("B", request.b, "Another one, of the same size")->required();
    app.add_option("--at-least", request.least_psnr_db, "Exit with 1 if the PSNR is below this, in dB");
    app.add_flag("--tone-map", request.tone_maps,
                 "Compress highlights of A as pointrt-view does in PNG files (above 0.906 of 1)");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kBadUsage);
    }
    return runTool("compare_pictures", [&] { return test::compare(request); });
}
