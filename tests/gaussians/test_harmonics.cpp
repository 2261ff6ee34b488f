// SPDX-License-Identifier: Apache-2.0
// Colours by direction: the basis against its definition, and how Gaussians use it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/gaussians/oracle.h"

namespace pointrt::test {
namespace {

using std::numbers::pi;

Double3 directionAt(double z, double azimuth) {
    const double radius = std::sqrt(1 - z * z);
    return {radius * std::cos(azimuth), radius * std::sin(azimuth), z};
}

/// Calls use(direction, weight) on a grid for which products of two functions of the basis are integrated by Simpson's
/// rule along z and, exactly, by equal weights around it.
template <typename Use>
void forSphere(const Use& use) {
    constexpr int kIntervals = 200, kAzimuths = 16; // azimuthal frequencies reach 6
    for (int i = 0; i <= kIntervals; ++i) {
        const double simpson = i == 0 || i == kIntervals ? 1 : i % 2 ? 4 : 2;
        const double weight = simpson / 3 * (2.0 / kIntervals) * (2 * pi / kAzimuths);
        for (int k = 0; k < kAzimuths; ++k) use(directionAt(2.0 * i / kIntervals - 1, 2 * pi * k / kAzimuths), weight);
    }
}

TEST(Harmonics, AreOrthonormal) {
    std::array<std::array<double, 16>, 16> products{};
    forSphere([&](const Double3& direction, double weight) {
        const std::array<double, 16> basis = harmonicBasis(direction);
        for (std::size_t i = 0; i < 16; ++i)
            for (std::size_t k = 0; k < 16; ++k) products[i][k] += weight * basis[i] * basis[k];
    });
    for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t k = 0; k < 16; ++k) EXPECT_NEAR(products[i][k], i == k ? 1 : 0, 1e-6) << i << ' ' << k;
}

/// The real harmonic of degree l and order m, from the standard library's, which has the phase of Condon and Shortley.
double realHarmonic(unsigned l, int m, double polar, double azimuth) {
    const auto order = static_cast<unsigned>(std::abs(m));
    const double legendre = std::sph_legendre(l, order, polar);
    if (m == 0) return legendre;
    return std::numbers::sqrt2 * legendre * (m > 0 ? std::cos(m * azimuth) : std::sin(order * azimuth));
}

TEST(Harmonics, HaveTheOrderAndSignsOfTheDefinition) {
    for (const double z : {-0.9, -0.3, 0.2, 0.7})
        for (const double azimuth : {0.4, 2.0, 3.9, 5.5}) {
            const std::array<double, 16> basis = harmonicBasis(directionAt(z, azimuth));
            std::size_t index = 0;
            for (int l = 0; l <= 3; ++l)
                for (int m = -l; m <= l; ++m, ++index)
                    EXPECT_NEAR(basis[index], realHarmonic(static_cast<unsigned>(l), m, std::acos(z), azimuth), 1e-12)
                        << l << ' ' << m;
        }
}

OracleGaussian tinted(const Double3& mean, std::vector<Double3> harmonics) {
    OracleGaussian gaussian;
    gaussian.mean = mean;
    gaussian.opacity = 0.5;
    gaussian.color = {0.5, 0.25, 0};
    gaussian.harmonics = std::move(harmonics);
    return gaussian;
}

TEST(Harmonics, AddToTheConstantColor) {
    const OracleGaussian gaussian = tinted({}, {{0, 0, 0}, {0.1, -0.2, 0.3}, {0, 0, 0}});
    const double basis = std::sqrt(3 / (4 * pi)); // the harmonic along z, at z = 1
    const Double3 color = colorAlong(gaussian, harmonicBasis({0, 0, 1}));
    EXPECT_NEAR(color[0], 0.5 + 0.1 * basis, 1e-12);
    EXPECT_NEAR(color[1], 0.25 - 0.2 * basis, 1e-12);
    EXPECT_NEAR(color[2], 0.3 * basis, 1e-12);
}

TEST(Harmonics, ColorsAreNotNegativeButMayExceedOne) {
    const OracleGaussian gaussian = tinted({}, {{0, 0, 0}, {5, -5, 0}, {0, 0, 0}});
    const Double3 color = colorAlong(gaussian, harmonicBasis({0, 0, 1}));
    EXPECT_GT(color[0], 1);
    EXPECT_EQ(color[1], 0);
}

TEST(Harmonics, FollowTheRayNotTheMean) {
    const OracleScene scene = oracleScene({tinted({0.5, 0, 1}, {{0, 0, 0}, {0, 0, 0}, {0.3, 0.3, 0.3}})});
    const OracleRay ray; // along z, beside the mean
    const std::vector<OracleHit> hits = hitsAlong(scene, ray);
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_NEAR(composite(scene, ray, hits).radiance[0], hits[0].alpha * 0.5, 1e-12) << "x is 0 along z";
}

} // namespace
} // namespace pointrt::test
