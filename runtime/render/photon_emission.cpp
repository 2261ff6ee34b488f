// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/photon_emission.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <utility>

#include "format/base/parallel.h"
#include "runtime/scene/light.h"
#include "runtime/util/pack.h"

namespace pointrt {

namespace {

using Numbers = std::array<double, 4>;

/// Steps of the R4 sequence: powers of the root of x^5 = x + 1 (Roberts, The Unreasonable Effectiveness of Quasirandom
/// Sequences, 2018).
constexpr Numbers kSteps = [] {
    constexpr double kRoot = 1.1673039782614187;
    Numbers steps{};
    double step = 1;
    for (double& each : steps) each = step /= kRoot;
    return steps;
}();

/// Fractional part of x in [0, 2^63).
double fraction(double x) { return x - static_cast<double>(static_cast<std::int64_t>(x)); }

Numbers quasiRandom(std::uint64_t i, const Numbers& shift) {
    Numbers u{};
    for (std::size_t k = 0; k < u.size(); ++k) u[k] = fraction(0.5 + kSteps[k] * static_cast<double>(i + 1) + shift[k]);
    return u;
}

/// The place of a map's photons in the sequence of all maps with count photons each, plus a random offset for seeds
/// other than 0.
Numbers shiftOf(PhotonSequence sequence, std::uint64_t count) {
    std::mt19937 random(sequence.seed);
    Numbers shift{};
    for (std::size_t k = 0; k < shift.size(); ++k) {
        // in two steps, since a large product would lose fractional digits
        const double map_step = fraction(kSteps[k] * static_cast<double>(count));
        const double of_seed = sequence.seed == 0 ? 0 : std::ldexp(static_cast<double>(random()), -32);
        shift[k] = fraction(map_step * sequence.map + of_seed);
    }
    return shift;
}

double brightness(const gpu::Light& light) { return (light.power.x + light.power.y + light.power.z) / 3.0; }

/// Photons that estimate the flux from a light to a target.
constexpr std::uint32_t kTrialPhotons = 256;

double pairFlux(const gpu::Light& light, const PhotonTarget& target, RenderSphere scene) {
    double sum = 0;
    for (std::uint32_t i = 0; i < kTrialPhotons; ++i) sum += photonOf(light, {target, scene, quasiRandom(i, {})}).share;
    return sum / kTrialPhotons * brightness(light);
}

/// The bits of a valid path are never all zero.
bool isEmitted(const gpu::PathState& path) { return path.bits != 0; }

} // namespace

PhotonEmission::PhotonEmission(std::span<const gpu::Light> lights, std::vector<PhotonTarget> targets,
                               RenderSphere scene, std::uint32_t count, PhotonSequence sequence)
    : targets_(std::move(targets)), scene_(scene) {
    std::vector<double> fluxes;
    for (const gpu::Light& light : lights)
        for (const PhotonTarget& target : targets_) fluxes.push_back(pairFlux(light, target, scene));
    double total = 0;
    for (const double flux : fluxes) total += flux;
    if (!(total > 0)) return;
    std::size_t pair = 0;
    // all pairs share one sequence, so that they are uncorrelated
    for (const gpu::Light& light : lights)
        for (const PhotonTarget& target : targets_) {
            const auto share = static_cast<std::uint64_t>(std::ceil(count * (fluxes[pair++] / total)));
            if (share > 0) pairs_.push_back({light, target, count_, share});
            count_ += share;
        }
    shift_ = shiftOf(sequence, count_);
}

/// The path of photon i; zero if it would carry no light.
gpu::PathState PhotonEmission::pathOf(std::uint64_t photon) const {
    const auto behind = std::upper_bound(pairs_.begin(), pairs_.end(), photon,
                                         [](std::uint64_t number, const Pair& pair) { return number < pair.first; });
    const Pair& pair = *std::prev(behind);
    const EmittedPhoton emitted = photonOf(pair.light, {pair.target, scene_, quasiRandom(photon, shift_)});
    gpu::PathState path{};
    if (!(emitted.share > 0)) return path;
    const auto pack = [](Vec3 v) {
        return gpu::vec3{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    path.origin = pack(emitted.origin);
    path.direction = pack(emitted.direction);
    path.throughput = pack(emitted.share * (1.0 / static_cast<double>(pair.count)) * unpack(pair.light.power));
    path.target = pair.target.code;
    path.bits = NO_OWNER << PATH_OWNER_SHIFT;
    return path;
}

std::vector<gpu::PathState> PhotonEmission::next(std::size_t most) {
    constexpr std::size_t kAtOnce = 4096; // a few milliseconds of a core
    std::vector<gpu::PathState> paths, tried;
    while (paths.size() < most && sent_ < count_) {
        tried.resize(std::min<std::uint64_t>(most - paths.size(), count_ - sent_));
        forAll((tried.size() + kAtOnce - 1) / kAtOnce, [&](std::size_t part) {
            const std::size_t first = part * kAtOnce, end = std::min(first + kAtOnce, tried.size());
            for (std::size_t i = first; i < end; ++i) tried[i] = pathOf(sent_ + i);
        });
        sent_ += tried.size();
        std::copy_if(tried.begin(), tried.end(), std::back_inserter(paths), isEmitted);
    }
    return paths;
}

} // namespace pointrt
