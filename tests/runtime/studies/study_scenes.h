// SPDX-License-Identifier: Apache-2.0
// Studies of grounds and boxes of discs, in coordinates of a national grid.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "pointrt/studies.hpp"
#include "runtime/gpu/device.h"
#include "tests/runtime/rays/ray_scenes.h"
#include "tests/support/temporary_folder.h"

namespace pointrt::test {

/// A level rectangle or a wall: a grid of points along two edges from corner, starting half a spacing inside.
struct Sheet {
    std::array<double, 3> corner, along, across; ///< cube units; the edges lie along axes
    std::array<float, 3> normal;
};

inline void addSheet(std::vector<pro_splat>& splats, const Sheet& sheet, double spacing, double radius) {
    const auto length = [](const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); };
    const auto columns = static_cast<int>(std::round(length(sheet.along) / spacing));
    const auto rows = static_cast<int>(std::round(length(sheet.across) / spacing));
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            pro_splat splat{{}, {sheet.normal[0], sheet.normal[1], sheet.normal[2]}, static_cast<float>(radius), {}, 0};
            for (std::size_t axis = 0; axis < 3; ++axis)
                splat.position[axis] =
                    static_cast<float>(sheet.corner[axis] + sheet.along[axis] * (column + 0.5) / columns +
                                       sheet.across[axis] * (row + 0.5) / rows);
            splats.push_back(splat);
        }
}

/// Four walls and a roof above ground at height low.
inline void addBox(std::vector<pro_splat>& splats, std::array<double, 3> low, std::array<double, 3> size,
                   double spacing, double radius) {
    const auto [x, y, z] = low;
    const auto [w, d, h] = size;
    addSheet(splats, {low, {w, 0, 0}, {0, 0, h}, {0, -1, 0}}, spacing, radius);
    addSheet(splats, {{x, y + d, z}, {w, 0, 0}, {0, 0, h}, {0, 1, 0}}, spacing, radius);
    addSheet(splats, {low, {0, d, 0}, {0, 0, h}, {-1, 0, 0}}, spacing, radius);
    addSheet(splats, {{x + w, y, z}, {0, d, 0}, {0, 0, h}, {1, 0, 0}}, spacing, radius);
    addSheet(splats, {{x, y, z + h}, {w, 0, 0}, {0, d, 0}, {0, 0, 1}}, spacing, radius);
}

/// Fails tests on messages of the validation layers.
class Study : public testing::Test {
protected:
    void TearDown() override { EXPECT_EQ(validationMessages(), messages_); }

    std::string scan(const std::string& name, const std::vector<pro_splat>& splats) {
        writeScan(folder.file(name), splats, {});
        return folder.file(name);
    }

    TemporaryFolder folder;
    TraceDevice device;
    std::uint64_t messages_ = validationMessages();
};

inline std::array<double, 3> towards(double elevation_deg, double azimuth_deg) {
    const double e = elevation_deg * std::numbers::pi / 180, a = azimuth_deg * std::numbers::pi / 180;
    return {std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)};
}

/// One light of weight 1.
inline Lights lightFrom(std::array<double, 3> direction) { return {{direction.begin(), direction.end()}, {1}}; }

} // namespace pointrt::test
