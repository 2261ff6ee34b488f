// SPDX-License-Identifier: Apache-2.0
// minimal SCAN.pro X Y Z PICTURE.png
// Casts one ray straight down from X Y Z, prints what it hits, and renders a picture of the scan. Build it with CMake:
// find_package(pointrt REQUIRED COMPONENTS trace) and target_link_libraries(minimal PRIVATE pointrt::trace).
#include <png.h>
#include <pointrt/render.hpp>
#include <pointrt/trace.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) try {
    if (argc != 6) return std::fputs("usage: minimal SCAN.pro X Y Z PICTURE.png\n", stderr), 2;
    const pointrt::TraceDevice device; // the best Vulkan device
    const pointrt::TraceScene scene(device, {argv[1]});

    // One ray: its origin and its direction, in the scan's own coordinates.
    const std::vector<double> ray{std::atof(argv[2]), std::atof(argv[3]), std::atof(argv[4]), 0, 0, -1};
    std::vector<double> distance(1), position(3);
    std::vector<std::uint32_t> splat(1);
    scene.castRays(std::span<const double>(ray), {}, {.t_hit = distance, .splat_ids = splat, .positions = position});
    if (splat[0] == pointrt::kNoHit)
        std::puts("no hit");
    else
        std::printf("splat %u at %.3f %.3f %.3f, distance %.3f\n", splat[0], position[0], position[1], position[2],
                    distance[0]);

    // A picture of the whole scan, framed automatically: linear RGBA floats, rows from the top.
    constexpr std::uint32_t width = 320, height = 240;
    pointrt::PictureRenderer renderer(device, {argv[1]}, {{"spp", "16"}});
    const pointrt::Picture picture = renderer.render(pointrt::LookAt{}, width, height, {"rgba"});
    const std::vector<float>& rgba = picture.layer("rgba").floats;
    std::vector<png_uint_16> linear(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < linear.size(); ++i)
        linear[i] = static_cast<png_uint_16>(65535 * std::clamp(rgba[i / 3 * 4 + i % 3], 0.0f, 1.0f));
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = width;
    png.height = height;
    png.format = PNG_FORMAT_LINEAR_RGB; // libpng converts it to 8-bit sRGB
    return png_image_write_to_file(&png, argv[5], 1, linear.data(), 0, nullptr) ? 0 : 4;
} catch (const pointrt::TraceError& error) {
    return std::fprintf(stderr, "minimal: error: %s\n", error.what()), static_cast<int>(error.kind);
}
