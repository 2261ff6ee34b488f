// SPDX-License-Identifier: Apache-2.0
// The integrators of shaders/shared/integrators.h as a C++ enumeration.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/util/names.h"
#include "shaders/shared/integrators.h"

namespace pointrt {

#define POINTRT_ENUMERATOR(number, Name, word, label, SHADING, traits) k##Name = number,
enum class Integrator { INTEGRATORS(POINTRT_ENUMERATOR) };
#undef POINTRT_ENUMERATOR

struct IntegratorRow {
    Integrator integrator;
    const char* word;  ///< on the command line and in scene files
    const char* label; ///< in the window
    std::uint32_t traits;
};

#define POINTRT_LISTED(number, Name, word, label, SHADING, traits)                                                     \
    IntegratorRow{Integrator::k##Name, word, label, traits},
constexpr std::array kIntegrators = {INTEGRATORS(POINTRT_LISTED)};
#undef POINTRT_LISTED

constexpr bool areNumberedInOrder() {
    for (std::uint32_t i = 0; i < kIntegrators.size(); ++i)
        if (static_cast<std::uint32_t>(kIntegrators[i].integrator) != i || kIntegrators[i].traits >> INTEGRATOR_BITS)
            return false;
    return INTEGRATOR_BITS * kIntegrators.size() <= 32;
}
static_assert(areNumberedInOrder(), "rows of INTEGRATORS must be numbered in order, and their traits fit in 32 bits");

#define POINTRT_NAME(number, Kind, word, label, SHADING, traits) Name{word, Integrator::k##Kind},
inline constexpr std::array kIntegratorNames = {INTEGRATORS(POINTRT_NAME)};
#undef POINTRT_NAME

/// True if the integrator has a trait INTEGRATOR_*.
constexpr bool hasTrait(Integrator integrator, std::uint32_t trait) {
    return integratorHas(static_cast<std::uint32_t>(integrator), trait);
}

/// True if one light is sampled at each hit; other integrators use all lights.
constexpr bool samplesOneLight(Integrator integrator) { return hasTrait(integrator, INTEGRATOR_IS_STOCHASTIC); }
constexpr bool usesLights(Integrator integrator) { return hasTrait(integrator, INTEGRATOR_USES_LIGHTS); }
/// True if hits trace shadow rays: to lights, or within a short distance (ambient occlusion).
constexpr bool castsShadowRays(Integrator integrator) {
    return hasTrait(integrator, INTEGRATOR_USES_LIGHTS | INTEGRATOR_IS_AMBIENT);
}

} // namespace pointrt
