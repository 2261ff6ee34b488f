// SPDX-License-Identifier: Apache-2.0
// The table of the directional albedo of GGX against its definition.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "runtime/device_scene/ggx_albedo.h"
#include "shaders/shared/ggx_table.h"

namespace pointrt {
namespace {

using std::numbers::pi;

/// The albedo by definition: an integral over light directions, in the angle of the half vector.
GgxAlbedo albedoByDefinition(double cosine, double roughness) {
    constexpr int kPolar = 1500, kAround = 600;
    const double alpha = roughness * roughness, sine = std::sqrt(1 - cosine * cosine);
    const auto lambda = [&](double z) { return (std::sqrt(1 + alpha * alpha * (1 - z * z) / (z * z)) - 1) / 2; };
    double given = 0, grazing = 0;
    for (int i = 0; i < kPolar; i++)
        for (int j = 0; j < kAround; j++) {
            const double x = (i + 0.5) / kPolar, theta = pi / 2 * x * x, phi = pi * (j + 0.5) / kAround;
            const double z = std::cos(theta), facing = sine * std::sin(theta) * std::cos(phi) + cosine * z;
            const double out = 2 * facing * z - cosine;
            if (facing <= 0 || out <= 0) continue;
            const double tangent2 = std::sin(theta) * std::sin(theta) / (z * z);
            const double slope = 1 + tangent2 / (alpha * alpha);
            const double normals = 1 / (pi * alpha * alpha * z * z * z * z * slope * slope);
            const double seen = 1 / (1 + lambda(cosine) + lambda(out));
            const double area = std::sin(theta) * pi * x / kPolar * 2 * pi / kAround;
            const double part = normals * seen * facing / cosine * area;
            given += part;
            grazing += part * std::pow(1 - facing, 5);
        }
    return {static_cast<float>(1 - given), static_cast<float>(grazing)};
}

TEST(GgxAlbedo, AgreesWithTheDefinition) {
    for (const double roughness : {0.1, 0.3, 0.55, 0.8, 1.0})
        for (const double cosine : {0.02, 0.1, 0.4, 0.8, 1.0}) {
            const GgxAlbedo quick = ggxAlbedoAt(cosine, roughness), slow = albedoByDefinition(cosine, roughness);
            EXPECT_NEAR(quick.lost, slow.lost, 0.002) << roughness << " " << cosine;
            EXPECT_NEAR(quick.grazing, slow.grazing, 0.002) << roughness << " " << cosine;
        }
}

TEST(GgxAlbedo, TableHoldsEntriesAndTheirMeans) {
    const std::vector<GgxAlbedo> table = ggxAlbedoTable();
    ASSERT_EQ(table.size(), static_cast<std::size_t>(GGX_TABLE_ENTRIES));
    constexpr std::size_t kSide = GGX_TABLE_SIDE;
    const GgxAlbedo corner = ggxAlbedoAt(1, 1), smoothest = ggxAlbedoAt(1, GGX_MIN_ROUGHNESS);
    EXPECT_EQ(table[kSide * kSide - 1].lost, corner.lost);
    EXPECT_NEAR(corner.lost, std::log(2.0), 1e-4); // for alpha 1, seen straight on, the integral of c / (1 + c) remains
    EXPECT_EQ(table[kSide - 1].lost, smoothest.lost);
    for (std::size_t row = 0; row < kSide; row++) {
        double lost = 0, grazing = 0;
        constexpr int kParts = 20000;
        for (int i = 0; i < kParts; i++) {
            const double cosine = (i + 0.5) / kParts, x = std::sqrt(cosine) * (kSide - 1);
            const std::size_t column = static_cast<std::size_t>(x);
            const double along = x - static_cast<double>(column);
            const GgxAlbedo a = table[row * kSide + column], b = table[row * kSide + column + 1];
            lost += (a.lost + along * (b.lost - a.lost)) * 2 * cosine / kParts;
            grazing += (a.grazing + along * (b.grazing - a.grazing)) * 2 * cosine / kParts;
        }
        EXPECT_NEAR(table[kSide * kSide + row].lost, lost, 1e-5) << row;
        EXPECT_NEAR(table[kSide * kSide + row].grazing, grazing, 1e-5) << row;
        EXPECT_GT(table[kSide * kSide + row].lost, 0) << "divided by: row " << row;
    }
}

} // namespace
} // namespace pointrt
