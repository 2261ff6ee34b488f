// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/light.h"

#include <algorithm>

namespace pointrt {
namespace {

#define CHECK_KIND(number, name, surface)                                                                              \
    static_assert(Light<name##Light>, "each kind of light must satisfy the concept Light of runtime/scene/light.h");   \
    static_assert(std::same_as<std::variant_alternative_t<number, LightDescription>, name##Light>,                     \
                  "LIGHT_KINDS and LightDescription must list the kinds in the same order");                           \
    static_assert(HasSurface<name##Light> == surface, "C++ and GLSL must agree on which lights have a surface");
LIGHT_KINDS(CHECK_KIND)
#undef CHECK_KIND

#define COUNT_KIND(number, name, surface) +1
static_assert(kLightKinds == 0 LIGHT_KINDS(COUNT_KIND), "LIGHT_KINDS lacks a kind of LightDescription");
#undef COUNT_KIND
static_assert(kLightKinds <= MAX_LIGHT_KINDS);

/// Returns visit(std::type_identity<L>{}), where L is the light type numbered kind, or fallback if no type has that
/// number.
template <typename Visit, typename Value>
Value ofKind(std::size_t kind, Value fallback, Visit&& visit) {
    eachLightKind([&](auto type, std::size_t number) {
        if (number == kind) fallback = visit(type);
    });
    return fallback;
}

template <typename Type>
using KindOf = typename Type::type;

} // namespace

const LightNames& namesOf(std::size_t kind) {
    return *ofKind(kind, static_cast<const LightNames*>(nullptr),
                   [](auto type) { return &KindOf<decltype(type)>::kNames; });
}

bool hasSurface(std::size_t kind) {
    return ofKind(kind, false, [](auto type) { return HasSurface<KindOf<decltype(type)>>; });
}

EmissionField emissionField(LightDescription& light) {
    return std::visit([](auto& kind) { return kind.emission(); }, light);
}

bool isVisible(const LightDescription& light) {
    return std::visit([](const auto& kind) { return kind.visible; }, light);
}

bool isSoft(const LightDescription& light) {
    return std::visit([](const auto& kind) { return kind.isSoft(); }, light);
}

std::optional<LampSurface> surfaceOf(const LightDescription& light) {
    return std::visit(
        []<typename L>(const L& kind) -> std::optional<LampSurface> {
            if constexpr (HasSurface<L>) return kind.surface();
            return std::nullopt;
        },
        light);
}

std::size_t countSurfaces(const std::vector<LightDescription>& lights) {
    return static_cast<std::size_t>(std::count_if(
        lights.begin(), lights.end(), [](const LightDescription& light) { return hasSurface(light.index()); }));
}

LightDescription newLightAt(std::size_t kind, const LightPlace& place) {
    return ofKind(kind, LightDescription{},
                  [&](auto type) -> LightDescription { return KindOf<decltype(type)>::newAt(place); });
}

gpu::Light rowOf(const LightDescription& light) {
    gpu::Light row = std::visit([](const auto& kind) { return kind.row(); }, light);
    LIGHT_KIND(row) = static_cast<float>(light.index());
    return row;
}

EmittedPhoton photonOf(const gpu::Light& row, const PhotonAim& aim) {
    return ofKind(static_cast<std::size_t>(LIGHT_KIND(row)), EmittedPhoton{},
                  [&](auto type) { return KindOf<decltype(type)>::photon(row, aim); });
}

} // namespace pointrt
