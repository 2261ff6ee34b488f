// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/colmap_images.h"

#include <array>
#include <cmath>

#include "preprocess/ingest/text.h"
#include "preprocess/input/points/byte_cursor.h"

namespace pointrt {
namespace {

/// pose: quaternion w x y z of the rotation from world to camera, whose y is down, then the translation
ColmapImage imageOf(const std::array<double, 7>& pose, std::string name) {
    ColmapImage image;
    image.name = std::move(name);
    const Eigen::Quaterniond camera_from_world = Eigen::Quaterniond(pose[0], pose[1], pose[2], pose[3]).normalized();
    const Eigen::Matrix3d world_from_camera = camera_from_world.conjugate().toRotationMatrix();
    image.center = -(world_from_camera * Vec3d(pose[4], pose[5], pose[6]));
    image.up = -world_from_camera.col(1);
    return image;
}

void addImage(std::uint32_t id, ColmapImage image, ColmapImages& images) {
    if (image.center.allFinite() && image.up.allFinite()) images.emplace(id, std::move(image));
}

ColmapImages readBinaryImages(const InputFile& input) {
    constexpr std::uint64_t kPointBytes = 24; // x, y, POINT3D_ID
    ColmapImages images;
    ByteCursor bytes{input, input.bytes};
    const auto count = bytes.take<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto id = bytes.take<std::uint32_t>();
        std::array<double, 7> pose{};
        for (double& value : pose) value = bytes.take<double>();
        bytes.take<std::uint32_t>(); // CAMERA_ID
        std::string name(bytes.takeUntil('\0'));
        bytes.takeArray(bytes.take<std::uint64_t>(), kPointBytes);
        addImage(id, imageOf(pose, std::move(name)), images);
    }
    return images;
}

/// Two lines for each image: its pose, and its 2D points, which may be none.
ColmapImages readTextImages(const InputFile& input) {
    ColmapImages images;
    std::string_view rest = input.bytes, line;
    while (nextLine(rest, line)) {
        std::string_view words = line;
        const std::string_view first = nextWord(words);
        if (first.empty() || first.starts_with('#')) continue;
        std::uint32_t id = 0;
        std::array<double, 7> pose{};
        bool good = wholeInteger(first, id);
        for (double& value : pose) good = good && wholeNumber(nextWord(words), value);
        nextWord(words); // CAMERA_ID
        const std::string_view name = nextWord(words);
        if (!good || name.empty())
            refuseLine(input, line.data(), "an image needs IMAGE_ID, QW QX QY QZ, TX TY TZ, CAMERA_ID and NAME");
        addImage(id, imageOf(pose, std::string(name)), images);
        nextLine(rest, line);
    }
    return images;
}

} // namespace

ColmapImages readColmapImages(const InputFile& input) {
    return input.name.ends_with(".txt") ? readTextImages(input) : readBinaryImages(input);
}

} // namespace pointrt
