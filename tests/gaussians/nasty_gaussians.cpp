// SPDX-License-Identifier: Apache-2.0
#include "tests/gaussians/nasty_gaussians.h"

#include <cmath>
#include <random>
#include <stdexcept>

namespace pointrt::test {

namespace {

/// Random numbers that are the same with every standard library.
struct Dice {
    std::mt19937_64 bits;

    double between(double low, double high) { return low + (high - low) * std::ldexp(double(bits() >> 11), -53); }
    /// A log-uniform number: equal ratios are equally likely.
    double scaled(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
    Double3 inCube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
};

constexpr double kLargestHarmonic = 0.2;
constexpr std::size_t kCopies = 4;
/// Cells per edge of the cube from 0 to 1.
constexpr double kCells = 16;

OracleGaussian blob(Dice& dice) {
    OracleGaussian gaussian;
    gaussian.mean = dice.inCube(1);
    for (double& deviation : gaussian.deviation) deviation = dice.scaled(0.01, 0.2);
    for (double& part : gaussian.rotation) part = dice.between(-1, 1);
    gaussian.opacity = dice.scaled(0.02, 1);
    gaussian.color = plus(Double3{0.5, 0.5, 0.5}, dice.inCube(0.5));
    gaussian.harmonics.resize(15);
    for (Double3& each : gaussian.harmonics) each = dice.inCube(kLargestHarmonic);
    return gaussian;
}

OracleGaussian giant(Dice& dice) {
    OracleGaussian gaussian = blob(dice);
    if (dice.between(0, 1) < 0.9) return gaussian;
    for (double& deviation : gaussian.deviation) deviation = dice.scaled(1, 1000);
    gaussian.mean = dice.inCube(100);
    gaussian.opacity = dice.scaled(0.01, 0.1);
    return gaussian;
}

OracleGaussian needle(Dice& dice) {
    OracleGaussian gaussian = blob(dice);
    const double longest = dice.scaled(0.1, 1);
    gaussian.deviation = {longest, longest / 1000, longest / 1000};
    return gaussian;
}

OracleGaussian layer(Dice& dice) {
    OracleGaussian gaussian = blob(dice);
    gaussian.mean = {0, 0, dice.between(-1, 1)};
    gaussian.deviation = {0.5, 0.5, 1e-4};
    gaussian.rotation = {1, 0, 0, 0};
    gaussian.opacity = dice.between(0.004, 0.006); // 2,000 of them let a ten-thousandth through
    return gaussian;
}

OracleGaussian around(Dice& dice) {
    OracleGaussian gaussian = blob(dice);
    gaussian.mean = dice.inCube(0.5);
    for (double& deviation : gaussian.deviation) deviation = dice.scaled(0.1, 2);
    gaussian.opacity = dice.scaled(0.004, 0.3);
    return gaussian;
}

OracleGaussian extreme(Dice& dice) {
    constexpr double kOpacities[] = {1, 0.004, 0.0039}; // 1/255 is 0.00392
    OracleGaussian gaussian = blob(dice);
    gaussian.opacity = kOpacities[dice.bits() % 3];
    return gaussian;
}

OracleGaussian onBorder(Dice& dice) {
    OracleGaussian gaussian = blob(dice);
    for (double& coordinate : gaussian.mean) coordinate = std::floor(std::abs(coordinate) * kCells) / kCells;
    return gaussian;
}

struct Kind {
    const char* name;
    OracleGaussian (*make)(Dice&);
};
constexpr Kind kKinds[] = {{"random", blob},   {"giants", giant},      {"needles", needle},  {"layers", layer},
                           {"inside", around}, {"opacities", extreme}, {"duplicates", blob}, {"borders", onBorder}};
constexpr const char* kMixed = "mixed";

const Kind& kindNamed(const std::string& name) {
    for (const Kind& kind : kKinds)
        if (kind.name == name) return kind;
    throw std::invalid_argument(name + " is not a kind of Gaussians");
}

/// Gives all Gaussians of a group the shape of its first one.
void duplicate(std::vector<OracleGaussian>& gaussians) {
    for (std::size_t k = 0; k < gaussians.size(); ++k) {
        const Double3 color = gaussians[k].color;
        gaussians[k] = gaussians[k - k % kCopies];
        gaussians[k].color = color;
    }
}

std::vector<OracleGaussian> makeMixed(std::size_t count, std::uint64_t seed) {
    constexpr std::size_t kKindCount = std::size(kKinds);
    std::vector<OracleGaussian> all;
    for (std::size_t i = 0; i < kKindCount; ++i)
        for (OracleGaussian& each : makeGaussians(kKinds[i].name, (count + i) / kKindCount, seed + i))
            all.push_back(std::move(each));
    return all;
}

} // namespace

std::vector<std::string> gaussianKinds() {
    std::vector<std::string> names;
    for (const Kind& kind : kKinds) names.emplace_back(kind.name);
    names.emplace_back(kMixed);
    return names;
}

std::vector<OracleGaussian> makeGaussians(const std::string& kind, std::size_t count, std::uint64_t seed) {
    if (kind == kMixed) return makeMixed(count, seed);
    const Kind& made = kindNamed(kind);
    Dice dice{std::mt19937_64(seed)};
    std::vector<OracleGaussian> gaussians(count);
    for (OracleGaussian& each : gaussians) each = made.make(dice);
    if (kind == "duplicates") duplicate(gaussians);
    return gaussians;
}

} // namespace pointrt::test
