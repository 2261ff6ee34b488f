// SPDX-License-Identifier: Apache-2.0
// Scans of known shape in coordinates of a national grid, written with format/ only.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "scene_builder.h"

namespace pointrt::test {

/// A cube of 128 m in UTM zone 33N; its edge is a power of two, so cube units convert to metres exactly.
struct GridPlace {
    std::array<double, 3> origin{500000, 4500000, 100};
    double edge = 128;

    std::array<double, 3> world(const float (&cube)[3]) const {
        return {origin[0] + edge * static_cast<double>(cube[0]), origin[1] + edge * static_cast<double>(cube[1]),
                origin[2] + edge * static_cast<double>(cube[2])};
    }
};

/// side x side overlapping splats of a level plane at this height, from margin to 1 - margin of the cube.
inline std::vector<pro_splat> planeSplats(std::size_t side, float height, float margin = 0.1f) {
    std::vector<pro_splat> splats;
    const float step = (1 - 2 * margin) / static_cast<float>(side);
    for (std::size_t y = 0; y < side; ++y)
        for (std::size_t x = 0; x < side; ++x)
            splats.push_back({{margin + step * (static_cast<float>(x) + 0.5f),
                               margin + step * (static_cast<float>(y) + 0.5f), height},
                              {0, 0, 1},
                              step,
                              {200, 200, 200},
                              0});
    return splats;
}

/// Overlapping splats of a sphere around the centre of the cube on a Fibonacci lattice, with normals outwards.
inline std::vector<pro_splat> sphereSplats(std::size_t count, float radius) {
    std::vector<pro_splat> splats;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    const double spacing = radius * std::sqrt(4 * std::numbers::pi / static_cast<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * static_cast<double>(i) + 1) / static_cast<double>(count);
        const double ring = std::sqrt(1 - z * z), angle = golden * static_cast<double>(i);
        const auto n = [](double v) { return static_cast<float>(v); };
        const float normal[3] = {n(ring * std::cos(angle)), n(ring * std::sin(angle)), n(z)};
        pro_splat splat{{}, {normal[0], normal[1], normal[2]}, n(1.2 * spacing), {255, 255, 255}, 0};
        for (int axis = 0; axis < 3; ++axis) splat.position[axis] = 0.5f + radius * normal[axis];
        splats.push_back(splat);
    }
    return splats;
}

/// Writes the splats as a .pro located at place.
inline void writeScan(const std::string& path, const std::vector<pro_splat>& splats, const GridPlace& place) {
    Scene scene = sceneOf(splats);
    scene.info.flags |= PRO_FLAG_ORIENTED;
    scene.info.scale = place.edge;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        scene.info.origin[axis] = place.origin[axis];
        for (double* bound : {&scene.info.bounds_min[axis], &scene.info.bounds_max[axis]})
            *bound = place.origin[axis] + place.edge * *bound;
    }
    scene.write(path);
}

} // namespace pointrt::test
