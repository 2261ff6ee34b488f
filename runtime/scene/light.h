// SPDX-License-Identifier: Apache-2.0
// Lights of any kind. What a kind has to say of itself is the concept Light below; the rest of the viewer asks through
// the functions here, and names no kind.
//
// To add one: its struct in a header beside this one, its line in LightDescription, its line in LIGHT_KINDS
// (shaders/shared/light_layout.h), and its functions in shaders/shade, included by lights.glsl. What is forgotten does
// not compile.
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

/// Stands for whatever asks for fields.
struct AnyFieldVisitor {
    void operator()(const auto&) const {}
};

template <typename L>
concept HasSurface = std::same_as<decltype(std::declval<const L&>().surface()), LampSurface>;

/// What a kind of light has, besides plain values that can be compared.
template <typename L>
concept Light = std::equality_comparable<L> && requires(L light, const L& given, const gpu::Light& row) {
    { L::kNames } -> std::same_as<const LightNames&>;
    light.eachField(AnyFieldVisitor{});                  // its values, in the order in which files and panels have them
    { light.emission() } -> std::same_as<EmissionField>; // the one of them that says how strong it is
    { L::newAt(LightPlace{}) } -> std::same_as<L>;       // one that somebody adds to a scene, still dark
    { given.isSoft() } -> std::same_as<bool>;            // whether its shadows are sampled
    requires HasSurface<L> || std::same_as<decltype(given.surface()), NoSurface>; // its shape, where it has one
    { given.row() } -> std::same_as<gpu::Light>; // for the device, but for its kind; lengths are render units
    { L::photon(row, std::declval<const PhotonAim&>()) } -> std::same_as<EmittedPhoton>; // towards a target
};

/// Lights with a direction that panels may turn say where they face, and turn there; up: of the scene.
template <typename L>
concept Turns = requires(L light, const L& given) {
    { given.facing() } -> std::same_as<Vec3>;
    light.face(Vec3{}, Vec3{});
};

/// task(std::type_identity<L>{}, number) for each kind of light L.
template <typename Task>
constexpr void eachLightKind(Task&& task) {
    [&]<std::size_t... kNumbers>(std::index_sequence<kNumbers...>) {
        (task(std::type_identity<std::variant_alternative_t<kNumbers, LightDescription>>{}, kNumbers), ...);
    }
    (std::make_index_sequence<kLightKinds>{});
}

/// Each kind's, by its number.
const LightNames& namesOf(std::size_t kind);
bool hasSurface(std::size_t kind);
/// The light's strength; its value is the light's own.
EmissionField emissionField(LightDescription& light);
/// Lights with a size cast soft shadows, which are sampled.
bool isSoft(const LightDescription& light);
std::optional<LampSurface> surfaceOf(const LightDescription& light);
std::size_t countSurfaces(const std::vector<LightDescription>& lights);
LightDescription newLightAt(std::size_t kind, const LightPlace& place);
/// For the device. Lengths of light are in render units.
gpu::Light rowOf(const LightDescription& light);
/// A photon of the light that has this row; none of the sky's image.
EmittedPhoton photonOf(const gpu::Light& row, const PhotonAim& aim);

} // namespace pointrt
