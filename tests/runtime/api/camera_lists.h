// SPDX-License-Identifier: Apache-2.0
// Lists of cameras as other programs write them.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace pointrt::test {

/// The pose of a camera at (1, 2, 3) that looks along +x with +z up: its axes in the world are right (0, -1, 0), down
/// (0, 0, -1) and forward (1, 0, 0). These are the rows of COLMAP's camera_from_world, which is the quaternion
/// (1, 1, -1, 1) / 2, followed by the translation that moves the eye to 0.
inline const std::string kColmapPose = "0.5 0.5 -0.5 0.5 2 3 -1";
/// The columns of nerfstudio's world_from_camera are right, up, back and the eye.
inline const std::string kTransformPose = "[[0, 0, -1, 1], [-1, 0, 0, 2], [0, 1, 0, 3], [0, 0, 0, 1]]";

inline const std::string kColmapCameras = "# Camera list\n1 PINHOLE 640 480 500 510 320.5 239.25\n";
inline const std::string kColmapImages =
    "# Image list\n7 " + kColmapPose + " 1 a/one.jpg\n\n8 " + kColmapPose + " 1 a/two.jpg\n1.5 2.5 -1 3 4 12\n";

class Packed {
public:
    template <typename Number>
    Packed& add(Number number) {
        bytes_.append(reinterpret_cast<const char*>(&number), sizeof number);
        return *this;
    }
    Packed& add(const std::string& name) {
        bytes_.append(name.c_str(), name.size() + 1);
        return *this;
    }
    const std::string& bytes() const { return bytes_; }

private:
    std::string bytes_;
};

/// kColmapCameras and kColmapImages in COLMAP's binary format.
inline std::string packedCameras() {
    Packed file;
    file.add(std::uint64_t{1}).add(std::uint32_t{1}).add(std::int32_t{1});
    file.add(std::uint64_t{640}).add(std::uint64_t{480}).add(500.0).add(510.0).add(320.5).add(239.25);
    return file.bytes();
}
inline std::string packedImages() {
    Packed file;
    file.add(std::uint64_t{2});
    for (const std::uint32_t number : {7u, 8u}) {
        file.add(number);
        for (const double value : {0.5, 0.5, -0.5, 0.5, 2.0, 3.0, -1.0}) file.add(value);
        file.add(std::uint32_t{1}).add(std::string(number == 7 ? "a/one.jpg" : "a/two.jpg"));
        const std::uint64_t points = number == 7 ? 0 : 2;
        file.add(points);
        for (std::uint64_t i = 0; i < points; ++i) file.add(1.5).add(2.5).add(std::int64_t{-1});
    }
    return file.bytes();
}

} // namespace pointrt::test
