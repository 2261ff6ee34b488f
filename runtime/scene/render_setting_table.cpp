// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/render_setting_table.h"

#include <algorithm>
#include <array>

#include "runtime/scene/default_lighting.h"

namespace pointrt {
namespace {

template <typename Value, typename Member>
void put(RenderSettings& settings, Member RenderSettings::*member, Value value) {
    settings.*member = value;
}

void put(RenderSettings& settings, SizeMembers member, PixelSize size) {
    settings.*member.width = size.width;
    settings.*member.height = size.height;
}

template <typename Value>
constexpr bool holds(const RenderSettings& settings, Value RenderSettings::*member, const void* address) {
    return &(settings.*member) == address;
}

constexpr bool holds(const RenderSettings& settings, SizeMembers member, const void* address) {
    return &(settings.*member.width) == address || &(settings.*member.height) == address;
}

/// Fails to compile when a member is added or removed: update the list.
[[maybe_unused]] constexpr bool everyMemberHasARow() {
    const RenderSettings settings;
    const auto& [width, height, spp, seed, camera, integrator, bounces, room, lights, background, shadows, caustics,
                 blend, splat_size, relight, reflectivity, color_by, color_map, color_range, legend, first_hits,
                 light_parts, denoise, exposure, detail] = settings;
    const std::array<const void*, 25> members = {&width,        &height,      &spp,       &seed,        &camera,
                                                 &integrator,   &bounces,     &room,      &lights,      &background,
                                                 &shadows,      &caustics,    &blend,     &splat_size,  &relight,
                                                 &reflectivity, &color_by,    &color_map, &color_range, &legend,
                                                 &first_hits,   &light_parts, &denoise,   &exposure,    &detail};
    const auto has_row = [&](const void* member) {
        bool found = false;
        forEachRenderSetting([&](const auto& row) { found |= holds(settings, row.member, member); });
        return found;
    };
    // the camera is resolved part by part; the others only add layers to a film
    const std::array<const void*, 3> elsewhere = {&camera, &first_hits, &light_parts};
    return std::all_of(members.begin(), members.end(), [&](const void* member) {
        return has_row(member) || std::find(elsewhere.begin(), elsewhere.end(), member) != elsewhere.end();
    });
}
#if !defined(__clang__) ||                                                                                             \
    __clang_major__ >= 16 // older versions cannot use std::string of libstdc++ in constant expressions
static_assert(everyMemberHasARow(), "a member of RenderSettings is in no row of kRenderSettings");
#endif

/// No two rows share a place in films or scene files.
constexpr bool placesAreUnique() {
    std::array<int, 64> film{}, scene{}, render{};
    ++film[kCameraPlaceInFilm];
    forEachRenderSetting([&](const auto& row) {
        if (row.film.place != 0) ++film.at(static_cast<std::size_t>(row.film.place));
        auto& table = row.scene_file.table == FileTable::kRender ? render : scene;
        ++table.at(static_cast<std::size_t>(row.scene_file.place));
    });
    const auto is_unique = [](const auto& places) {
        return std::all_of(places.begin(), places.end(), [](int rows) { return rows <= 1; });
    };
    return is_unique(film) && is_unique(scene) && is_unique(render);
}
static_assert(placesAreUnique(), "two rows of kRenderSettings have the same place");

static_assert(kRingLights == 3, "the help of --lights and docs/SCENES.md name their number");

} // namespace

void applyChoices(const RenderChoices& choices, RenderSettings& settings) {
    forEachRenderSetting([&](const auto& row) {
        if (const auto& choice = choices.*row.choice) put(settings, row.member, *choice);
    });
}

RenderChoices choicesOf(const RenderSettings& settings) {
    RenderChoices choices;
    forEachRenderSetting([&](const auto& row) { choices.*row.choice = settingOf(settings, row.member); });
    return choices;
}

} // namespace pointrt
