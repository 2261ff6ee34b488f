// SPDX-License-Identifier: Apache-2.0
// The integrators (shaders/shared/integrators.h) as C++ knows them.
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
    const char* word;  ///< of the command line and scene files
    const char* label; ///< of the window
    std::uint32_t traits;
};

#define POINTRT_LISTED(number, Name, word, label, SHADING, traits)                                                     \
    IntegratorRow{Integrator::k##Name, word, label, traits},
constexpr std::array kIntegrators = {INTEGRATORS(POINTRT_LISTED)};
#undef POINTRT_LISTED

constexpr bool countsFromZero() {
    for (std::uint32_t i = 0; i < kIntegrators.size(); ++i)
        if (static_cast<std::uint32_t>(kIntegrators[i].integrator) != i || kIntegrators[i].traits >> INTEGRATOR_BITS)
            return false;
    return INTEGRATOR_BITS * kIntegrators.size() <= 32;
}
static_assert(countsFromZero(), "rows of INTEGRATORS are numbered as they stand, and their traits fit in one number");

#define POINTRT_NAME(number, Kind, word, label, SHADING, traits) Name{word, Integrator::k##Kind},
inline constexpr std::array kIntegratorNames = {INTEGRATORS(POINTRT_NAME)};
#undef POINTRT_NAME

/// Whether it has one of INTEGRATOR_*.
constexpr bool hasTrait(Integrator integrator, std::uint32_t trait) {
    return integratorHas(static_cast<std::uint32_t>(integrator), trait);
}

/// At each hit, where the others ask all.
constexpr bool asksOneLight(Integrator integrator) { return hasTrait(integrator, INTEGRATOR_BY_CHANCE); }
constexpr bool showsLight(Integrator integrator) { return hasTrait(integrator, INTEGRATOR_SHOWS_LIGHT); }

} // namespace pointrt
