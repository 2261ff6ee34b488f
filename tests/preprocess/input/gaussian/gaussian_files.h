// SPDX-License-Identifier: Apache-2.0
// Files of Gaussians in all formats but SOG and glTF, written byte by byte.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/preprocess/input/input_fixture.h"

namespace pointrt::test {

/// A Gaussian, to be encoded in each format.
struct Blob {
    std::array<float, 3> centre = {1.5f, -2, 0.25f};
    std::array<float, 3> log_deviations = {-2, -3, -5};
    std::array<float, 4> rotation = {1, 0, 0, 0}; ///< w x y z
    float opacity = 0.8f;
    std::array<float, 3> color = {0, 9, -9}; ///< f_dc
    std::vector<float> rest = {};            ///< f_rest
};

/// A quarter rotation about +x, which takes +z to -y.
inline const std::array<float, 4> kQuarterAboutX = {std::sqrt(0.5f), std::sqrt(0.5f), 0, 0};

/// count: of vertices; flat: 2D Gaussians; rest: number of f_rest properties
std::string plyHeader(std::size_t count, bool flat = false, std::size_t rest = 0);
std::string plyRow(const Blob& blob, bool flat = false);

/// A PLY of 3D Gaussians, which must have the same number of f_rest.
std::string gaussianPly(const std::vector<Blob>& blobs);

/// A packed PLY of 1 or 257 splats; the last one is in a chunk of its own.
/// @param harmonics bytes of an element "sh" behind the vertices, rest of each
std::string packedPly(std::uint32_t count, bool color_range, std::uint32_t rotation, const std::string& harmonics = "",
                      std::size_t rest = 0);

/// 10-bit components cannot represent zero; the nearest value is half a step away.
inline constexpr std::uint32_t kNearlyStill = 512u << 20 | 512u << 10 | 512u;

std::string splatRow(const Blob& blob);

struct Spz {
    std::uint32_t version = 3, count = 1;
    std::uint8_t degree = 0, fractional_bits = 12, streams = 5;
};

std::string spzHeader(const Spz& spz);
/// One splat, with its rotation in the encoding of the version.
std::vector<std::string> spzArrays(std::uint32_t version, bool turned = false);
std::string spz4(const std::vector<std::string>& arrays, Spz spz = {4});
std::string zstdPacked(const std::string& bytes);
std::string joined(const std::vector<std::string>& parts);

} // namespace pointrt::test
