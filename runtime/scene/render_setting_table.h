// SPDX-License-Identifier: Apache-2.0
// The table of render settings: all that there is to know of one stands in its row. Command line and --help, scene
// files read and written, the settings of a run, the signature of its film and the window's panel come from here, and
// the tests hold docs/SCENES.md against it. A new setting is a member of RenderSettings, one of RenderChoices and a
// row.
#pragma once

#include <limits>
#include <tuple>
#include <type_traits>

#include "runtime/scene/render_settings.h"
#include "runtime/scene/setting_limits.h"

namespace pointrt {

/// Headings of --help that settings stand under, in the order of the table.
enum class HelpGroup { kImage, kLightAndSurfaces };

struct OnCommandLine {
    HelpGroup group;
    const char* option;
    const char* placeholder;
    const char* help; ///< {default} and {limits} stand for what they are
};

/// Tables of a scene file that have settings: the whole file and [render].
enum class FileTable { kScene, kRender };

struct InSceneFile {
    FileTable table;
    int place; ///< in its table, as files are written
    const char* key;
};

/// Whether samples with one value and samples with another can be in the same film. Where they cannot, an entry of the
/// film's signature tells (film_signature.h), and its place there is for ever: films are gone on with years later.
struct InFilm {
    int place; ///< 0: in no signature
    const char* name;
    const char* (*text)(const RenderSettings&) = nullptr; ///< else the value, or "default" for one that is not there
    bool where_said = false; ///< no entry for the default: of settings that came after films without them
};
inline constexpr InFilm kNotInFilm{0, ""};
/// Of the camera, which is no setting of this table.
inline constexpr int kCameraPlaceInFilm = 2;

/// Where two members of RenderSettings are one setting.
struct SizeMembers {
    std::uint32_t RenderSettings::*width;
    std::uint32_t RenderSettings::*height;
};

template <typename Members, typename Limits>
struct RenderSetting {
    using Value = typename Limits::Value;
    Members member; ///< a pointer to a member, or SizeMembers
    std::optional<Value> RenderChoices::*choice;
    Limits limits;
    OnCommandLine command_line;
    InSceneFile scene_file;
    InFilm film;
};
template <typename Members, typename Limits>
RenderSetting(Members, std::optional<typename Limits::Value> RenderChoices::*, Limits, OnCommandLine, InSceneFile,
              InFilm) -> RenderSetting<Members, Limits>;

/// One sample goes through the pixel's centre, more are spread over its area: more of them go on with each other.
inline const char* pixelPattern(const RenderSettings& settings) { return settings.spp == 1 ? "centre" : "area"; }

// clang-format off
inline constexpr std::tuple kRenderSettings{
    RenderSetting{SizeMembers{&RenderSettings::width, &RenderSettings::height}, &RenderChoices::size,
        SizeRange{kMaxPixelSide},
        OnCommandLine{HelpGroup::kImage, "--size", "WxH", "Image size in pixels (default {default}, each {limits})"},
        InSceneFile{FileTable::kRender, 4, "size"},
        InFilm{1, "size"}},
    RenderSetting{&RenderSettings::spp, &RenderChoices::spp,
        CountRange{1, kMaxSpp},
        OnCommandLine{HelpGroup::kImage, "--spp", "N",
            "Samples a pixel; 1 samples its centre (default {default}, {limits})"},
        InSceneFile{FileTable::kRender, 3, "spp"},
        InFilm{6, "pixel", pixelPattern}},
    RenderSetting{&RenderSettings::seed, &RenderChoices::seed,
        CountRange{0, std::numeric_limits<std::uint32_t>::max()},
        OnCommandLine{HelpGroup::kImage, "--seed", "N", "Of the random numbers (default {default}, {limits})"},
        InSceneFile{FileTable::kRender, 5, "seed"},
        InFilm{5, "seed"}},
    RenderSetting{&RenderSettings::denoise, &RenderChoices::denoise,
        OneOf{kDenoiseNames},
        OnCommandLine{HelpGroup::kImage, "--denoise", "on|off|auto",
            "Filter the noise out: a guess, for previews (default {default}: PNG of soft light with fewer than 256 "
            "samples)"},
        InSceneFile{FileTable::kRender, 6, "denoise"},
        kNotInFilm},
    RenderSetting{&RenderSettings::exposure, &RenderChoices::exposure,
        RealRange{-20, 20}, // stops: a factor of a million
        OnCommandLine{HelpGroup::kImage, "--exposure", "STOPS",
            "Brighten a PNG by 2^STOPS (default {default}, {limits})"},
        InSceneFile{FileTable::kRender, 7, "exposure"},
        kNotInFilm},
    RenderSetting{&RenderSettings::detail, &RenderChoices::detail,
        RealRange{0, kMaxPixelSide}, // nothing is larger in a picture
        OnCommandLine{HelpGroup::kImage, "--detail", "PIXELS",
            "So large may be what the tiles of a set leave out; 0: all of it at its finest (default {default}, "
            "{limits})"},
        InSceneFile{FileTable::kRender, 17, "detail"},
        kNotInFilm}, // the scene's files tell: with the same tiles a film goes on
    RenderSetting{&RenderSettings::integrator, &RenderChoices::integrator,
        OneOf{kIntegratorNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--integrator", "NAME", "{limits} (default {default})"},
        InSceneFile{FileTable::kRender, 1, "integrator"},
        InFilm{3, "integrator"}},
    RenderSetting{&RenderSettings::bounces, &RenderChoices::bounces,
        CountRange{0, 64},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--bounces", "N",
            "Secondary rays in a path at most (default {default}, {limits})"},
        InSceneFile{FileTable::kRender, 2, "bounces"},
        InFilm{4, "bounces"}},
    RenderSetting{&RenderSettings::room, &RenderChoices::room,
        OneOf{kRoomNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--room", "NAME",
            "A box around the scene: {limits} (default: none; without --lights too, and without lights in the scene, a "
            "studio of three lamps over a floor)"},
        InSceneFile{FileTable::kScene, 1, "room"},
        InFilm{7, "room"}},
    RenderSetting{&RenderSettings::lights, &RenderChoices::lights,
        CountRange{0, 16},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--lights", "N",
            "Point lights on a ring above a scene that has no light of its own (default 3 with --room, {limits})"},
        InSceneFile{FileTable::kRender, 8, "lights"},
        InFilm{8, "lights"}},
    RenderSetting{&RenderSettings::shadows, &RenderChoices::shadows,
        OneOf{kSwitchNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--shadows", "on|off", "Shadow rays (default {default})"},
        InSceneFile{FileTable::kRender, 9, "shadows"},
        InFilm{9, "shadows"}},
    RenderSetting{&RenderSettings::blend, &RenderChoices::blend,
        OneOf{kSwitchNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--blend", "on|off", "Blend overlapping splats (default {default})"},
        InSceneFile{FileTable::kRender, 11, "blend"},
        InFilm{10, "blend"}},
    RenderSetting{&RenderSettings::caustics, &RenderChoices::caustics,
        OneOf{kSwitchNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--caustics", "on|off",
            "Light bundled by glass and mirrors (default {default})"},
        InSceneFile{FileTable::kRender, 10, "caustics"},
        InFilm{11, "caustics"}},
    RenderSetting{&RenderSettings::reflectivity, &RenderChoices::reflectivity,
        RealRange{0, 1},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--reflectivity", "R",
            "Of scans with their files' own materials, 0 matte to 1 mirror (default: each material's own)"},
        InSceneFile{FileTable::kRender, 12, "reflectivity"},
        InFilm{12, "reflectivity"}},
    RenderSetting{&RenderSettings::color_by, &RenderChoices::color_by,
        AttributeWord{},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--color-by", "NAME",
            "Colour scans by {limits} (default {default}: their own colours)"},
        InSceneFile{FileTable::kRender, 13, "color_by"},
        InFilm{13, "color_by", nullptr, true}},
    RenderSetting{&RenderSettings::color_map, &RenderChoices::color_map,
        OneOf{kColorMapNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--color-map", "NAME",
            "{limits} (default viridis, classes for classes, scans for scans)"},
        InSceneFile{FileTable::kRender, 14, "color_map"},
        InFilm{14, "color_map", nullptr, true}},
    RenderSetting{&RenderSettings::color_range, &RenderChoices::color_range,
        RangeOfValues{},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--color-range", "LO,HI",
            "Numbers at the ends of the map, {limits} (default: all of small whole numbers, else without the lowest "
            "and the highest percent)"},
        InSceneFile{FileTable::kRender, 15, "color_range"},
        InFilm{15, "color_range", nullptr, true}},
    RenderSetting{&RenderSettings::legend, &RenderChoices::legend,
        OneOf{kSwitchNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--legend", "on|off",
            "What the colours of --color-by mean, in the corner of the picture (default: on in the window, off in "
            "PNGs; never in EXRs)"},
        InSceneFile{FileTable::kRender, 16, "legend"},
        kNotInFilm},
};
// clang-format on

/// visit(row) for each row of the table.
template <typename Visit>
constexpr void forEachRenderSetting(Visit visit) {
    std::apply([&](const auto&... row) { (visit(row), ...); }, kRenderSettings);
}

/// The row of a member of RenderSettings: rowOf<&RenderSettings::bounces>().limits.
template <auto kMember, std::size_t kRow = 0>
constexpr const auto& rowOf() {
    static_assert(kRow < std::tuple_size_v<decltype(kRenderSettings)>, "that member is in no row of the table");
    constexpr const auto& row = std::get<kRow>(kRenderSettings);
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(row.member)>, decltype(kMember)>) {
        if constexpr (row.member == kMember)
            return row;
        else
            return rowOf<kMember, kRow + 1>();
    } else {
        return rowOf<kMember, kRow + 1>();
    }
}

/// What settings have in a row; empty where that is left to the scene.
template <typename Value>
constexpr std::optional<Value> settingOf(const RenderSettings& settings, Value RenderSettings::*member) {
    return settings.*member;
}
template <typename Value>
constexpr std::optional<Value> settingOf(const RenderSettings& settings, std::optional<Value> RenderSettings::*member) {
    return settings.*member;
}
constexpr std::optional<PixelSize> settingOf(const RenderSettings& settings, SizeMembers member) {
    return PixelSize{settings.*member.width, settings.*member.height};
}

/// Where choices speak, they overrule settings.
void applyChoices(const RenderChoices& choices, RenderSettings& settings);
/// All that settings have to say.
RenderChoices choicesOf(const RenderSettings& settings);

} // namespace pointrt
