// SPDX-License-Identifier: Apache-2.0
// Lights of any kind. Each kind satisfies the concept Light; the rest of the viewer uses the functions below and does
// not name the kinds.
//
// To add a kind: a struct in a header beside this one, a line in LightDescription, a line in LIGHT_KINDS
// (shaders/shared/light_layout.h), and functions in shaders/shade, included by lights.glsl. Omissions fail to compile.
#pragma once

#include <concepts>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include "runtime/scene/disc_light.h"
#include "runtime/scene/point_light.h"
#include "runtime/scene/quad_light.h"
#include "runtime/scene/sphere_light.h"
#include "runtime/scene/spot_light.h"
#include "runtime/scene/sun_light.h"

namespace pointrt {

/// In the order of LIGHT_KINDS.
using LightDescription = std::variant<PointLight, SpotLight, SunLight, SphereLight, QuadLight, DiscLight>;
constexpr std::size_t kLightKinds = std::variant_size_v<LightDescription>;

/// A visitor of fields, for the concept Light.
struct AnyFieldVisitor {
    void operator()(const auto&) const {}
};

template <typename L>
concept HasSurface = std::same_as<decltype(std::declval<const L&>().surface()), LampSurface>;

/// The interface of a kind of light, besides plain values that can be compared.
template <typename L>
concept Light = std::equality_comparable<L> && requires(L light, const L& given, const gpu::Light& row) {
    { L::kNames } -> std::same_as<const LightNames&>;
    light.eachField(AnyFieldVisitor{});                  // the light's values, in the order of files and panels
    { light.emission() } -> std::same_as<EmissionField>; // which of the values is its strength
    { L::newAt(LightPlace{}) } -> std::same_as<L>;       // a new light, of strength 0
    { given.isSoft() } -> std::same_as<bool>;            // true if shadow rays sample it
    requires HasSurface<L> || std::same_as<decltype(given.surface()), NoSurface>; // the shape of its surface, if any
    { given.row() } -> std::same_as<gpu::Light>; // the device's row, without the kind; render units
    { L::photon(row, std::declval<const PhotonAim&>()) } -> std::same_as<EmittedPhoton>; // a photon towards a target
};

/// Lights with a direction that panels can change: facing() returns it, face(direction, scene up) sets it.
template <typename L>
concept Aimable = requires(L light, const L& given) {
    { given.facing() } -> std::same_as<Vec3>;
    light.face(Vec3{}, Vec3{});
};

/// Calls task(std::type_identity<L>{}, number) for each kind of light L.
template <typename Task>
constexpr void eachLightKind(Task&& task) {
    [&]<std::size_t... kNumbers>(std::index_sequence<kNumbers...>) {
        (task(std::type_identity<std::variant_alternative_t<kNumbers, LightDescription>>{}, kNumbers), ...);
    }
    (std::make_index_sequence<kLightKinds>{});
}

/// The names of the kind with this number.
const LightNames& namesOf(std::size_t kind);
bool hasSurface(std::size_t kind);
/// The light's strength, by reference to its value.
EmissionField emissionField(LightDescription& light);
bool isVisible(const LightDescription& light);
/// True for lights with a size: their soft shadows are sampled.
bool isSoft(const LightDescription& light);
std::optional<LampSurface> surfaceOf(const LightDescription& light);
std::size_t countSurfaces(const std::vector<LightDescription>& lights);
LightDescription newLightAt(std::size_t kind, const LightPlace& place);
/// The device's row of a light; its lengths must be in render units.
gpu::Light rowOf(const LightDescription& light);
/// A photon of the light of this row; the sky's image emits none.
EmittedPhoton photonOf(const gpu::Light& row, const PhotonAim& aim);

} // namespace pointrt
