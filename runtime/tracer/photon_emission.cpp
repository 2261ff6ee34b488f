// SPDX-License-Identifier: Apache-2.0
#include "runtime/tracer/photon_emission.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "runtime/light/light.h"
#include "runtime/util/pack.h"

namespace pointrt {

namespace {

/// R4 sequence: steps by powers of the root of x^5 = x + 1 (Roberts, The Unreasonable Effectiveness of Quasirandom
/// Sequences, 2018).
std::array<double, 4> quasiRandom(std::uint64_t i) {
    constexpr double kRoot = 1.1673039782614187;
    std::array<double, 4> u{};
    double step = 1;
    for (double& value : u) {
        step /= kRoot;
        value = std::fmod(0.5 + step * static_cast<double>(i + 1), 1.0);
    }
    return u;
}

double brightness(const gpu::Light& light) { return (light.power.x + light.power.y + light.power.z) / 3.0; }

/// Photons that find out how much light a pair carries.
constexpr std::uint32_t kTrialPhotons = 256;

double pairFlux(const gpu::Light& light, const PhotonTarget& target, RenderSphere scene) {
    double sum = 0;
    for (std::uint32_t i = 0; i < kTrialPhotons; ++i) sum += photonOf(light, {target, scene, quasiRandom(i)}).share;
    return sum / kTrialPhotons * brightness(light);
}

gpu::PathState pathOf(const EmittedPhoton& photon, const gpu::Light& light, double scale, std::uint32_t code) {
    const auto pack = [](Vec3 v) {
        return gpu::vec3{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    gpu::PathState path{};
    path.origin = pack(photon.origin);
    path.direction = pack(photon.direction);
    path.throughput = pack(photon.share * scale * unpack(light.power));
    path.target = code;
    path.bits = NO_OWNER << PATH_OWNER_SHIFT;
    return path;
}

} // namespace

std::vector<gpu::PathState> emitPhotons(std::span<const gpu::Light> lights, std::span<const PhotonTarget> targets,
                                        RenderSphere scene, std::uint32_t count) {
    std::vector<double> fluxes;
    for (const gpu::Light& light : lights)
        for (const PhotonTarget& target : targets) fluxes.push_back(pairFlux(light, target, scene));
    double total = 0;
    for (const double flux : fluxes) total += flux;
    std::vector<gpu::PathState> paths;
    if (!(total > 0)) return paths;
    std::size_t pair = 0;
    std::uint64_t first = 0; // pairs go on in one sequence, so that they are not alike
    for (const gpu::Light& light : lights)
        for (const PhotonTarget& target : targets) {
            const auto share = static_cast<std::uint64_t>(std::ceil(count * (fluxes[pair++] / total)));
            for (std::uint64_t i = 0; i < share; ++i) {
                const EmittedPhoton photon = photonOf(light, {target, scene, quasiRandom(first + i)});
                if (photon.share > 0)
                    paths.push_back(pathOf(photon, light, 1.0 / static_cast<double>(share), target.code));
            }
            first += share;
        }
    return paths;
}

} // namespace pointrt
