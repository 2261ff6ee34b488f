// SPDX-License-Identifier: Apache-2.0
// The table of render settings: one row defines everything about a setting. The command line and --help, scene files,
// the settings of a run, the signature of its film and the window's panel all use it, and tests compare docs/SCENES.md
// with it. A new setting needs a member of RenderSettings, one of RenderChoices and a row.
#pragma once

#include <limits>
#include <tuple>
#include <type_traits>

#include "runtime/scene/render_settings.h"
#include "runtime/scene/setting_limits.h"

namespace pointrt {

/// The headings of settings in --help, in the order of the table.
enum class HelpGroup { kImage, kLightAndSurfaces };

struct OnCommandLine {
    HelpGroup group;
    const char* option;
    const char* placeholder;
    const char* help; ///< {default} and {limits} are replaced by their values
};

/// The tables of a scene file that contain settings: the top level and [render].
enum class FileTable { kScene, kRender };

struct InSceneFile {
    FileTable table;
    int place; ///< its position in the table when a file is written
    const char* key;
};

/// Whether a film can mix samples taken with different values of the setting. If not, the value is an entry of the
/// film's signature (film_signature.h). Its place there never changes, since films are resumed years later.
struct InFilm {
    int place; ///< 0: not in the signature
    const char* name;
    const char* (*text)(const RenderSettings&) = nullptr; ///< default: the value, or "default" if it is not set
    bool omits_default = false; ///< no entry for the default value, because films older than the setting have none
};
inline constexpr InFilm kNotInFilm{0, ""};
/// The camera's place in the signature; it is not in this table.
inline constexpr int kCameraPlaceInFilm = 2;

/// Two members of RenderSettings that are one setting.
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

/// A single sample is taken at the pixel's centre, several are spread over its area: a film of one sample cannot be
/// mixed with films of several.
inline const char* pixelPattern(const RenderSettings& settings) { return settings.spp == 1 ? "centre" : "area"; }

// clang-format off
inline constexpr std::tuple kRenderSettings{
    RenderSetting{SizeMembers{&RenderSettings::width, &RenderSettings::height}, &RenderChoices::size,
        SizeRange{kMaxPixelSide},
        OnCommandLine{HelpGroup::kImage, "--size", "WxH", "Image size in pixels (default {default}; each side {limits})"},
        InSceneFile{FileTable::kRender, 4, "size"},
        InFilm{1, "size"}},
    RenderSetting{&RenderSettings::spp, &RenderChoices::spp,
        CountRange{1, kMaxSpp},
        OnCommandLine{HelpGroup::kImage, "--spp", "N",
            "Samples per pixel; 1 samples its centre (default {default}, or 8 where --integrator defaults to path; "
            "{limits})"},
        InSceneFile{FileTable::kRender, 3, "spp"},
        InFilm{6, "pixel", pixelPattern}},
    RenderSetting{&RenderSettings::seed, &RenderChoices::seed,
        CountRange{0, std::numeric_limits<std::uint32_t>::max()},
        OnCommandLine{HelpGroup::kImage, "--seed", "N", "Random seed (default {default}; {limits})"},
        InSceneFile{FileTable::kRender, 5, "seed"},
        InFilm{5, "seed"}},
    RenderSetting{&RenderSettings::denoise, &RenderChoices::denoise,
        OneOf{kDenoiseNames},
        OnCommandLine{HelpGroup::kImage, "--denoise", "on|off|auto",
            "Denoise the picture, for previews; may blur detail (default {default}: noisy PNGs with fewer than 256 "
            "samples per pixel)"},
        InSceneFile{FileTable::kRender, 6, "denoise"},
        kNotInFilm},
    RenderSetting{&RenderSettings::exposure, &RenderChoices::exposure,
        RealRange{-20, 20}, // stops: a factor of a million
        OnCommandLine{HelpGroup::kImage, "--exposure", "STOPS",
            "Multiply the brightness of PNG and TIFF pictures by 2^STOPS (default {default}; {limits})"},
        InSceneFile{FileTable::kRender, 7, "exposure"},
        kNotInFilm},
    RenderSetting{&RenderSettings::detail, &RenderChoices::detail,
        RealRange{0, kMaxPixelSide}, // no error is larger than the picture
        OnCommandLine{HelpGroup::kImage, "--detail", "PIXELS",
            "Largest level-of-detail error of tile sets to accept, in pixels; 0 loads the finest tiles (default "
            "{default}; {limits})"},
        InSceneFile{FileTable::kRender, 17, "detail"},
        kNotInFilm}, // the signature lists the scene's tiles instead
    RenderSetting{&RenderSettings::integrator, &RenderChoices::integrator,
        OneOf{kIntegratorNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--integrator", "NAME",
            "Rendering method: {limits} (default {default}, or path for a PNG of a scan seen from outside if no "
            "option sets samples, light or surfaces)"},
        InSceneFile{FileTable::kRender, 1, "integrator"},
        InFilm{3, "integrator"}},
    RenderSetting{&RenderSettings::bounces, &RenderChoices::bounces,
        CountRange{0, 64},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--bounces", "N",
            "Maximum number of bounces in a path (default {default}; {limits})"},
        InSceneFile{FileTable::kRender, 2, "bounces"},
        InFilm{4, "bounces"}},
    RenderSetting{&RenderSettings::room, &RenderChoices::room,
        OneOf{kRoomNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--room", "NAME",
            "Box around the scene: {limits} (default: none; a scene without lights gets a studio of three lamps and "
            "a floor, unless --lights is given)"},
        InSceneFile{FileTable::kScene, 1, "room"},
        InFilm{7, "room"}},
    RenderSetting{&RenderSettings::lights, &RenderChoices::lights,
        CountRange{0, 16},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--lights", "N",
            "Number of point lights on a ring above a scene without lights of its own (default 3 with --room; "
            "{limits})"},
        InSceneFile{FileTable::kRender, 8, "lights"},
        InFilm{8, "lights"}},
    RenderSetting{&RenderSettings::background, &RenderChoices::background,
        BackgroundWord{},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--background", "COLOR",
            "Plain background: {limits}. It replaces the sky and the studio floor, and turns off the compression of "
            "highlights; transparent writes RGBA PNGs (default: none; scenes that hold only Gaussian captures get "
            "black and no lamps)"},
        InSceneFile{FileTable::kScene, 2, "background"},
        InFilm{16, "background", nullptr, true}},
    RenderSetting{&RenderSettings::shadows, &RenderChoices::shadows,
        OneOf{kSwitchNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--shadows", "on|off", "Trace shadow rays (default {default})"},
        InSceneFile{FileTable::kRender, 9, "shadows"},
        InFilm{9, "shadows"}},
    RenderSetting{&RenderSettings::blend, &RenderChoices::blend,
        OneOf{kSwitchNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--blend", "on|off", "Blend overlapping splats (default {default})"},
        InSceneFile{FileTable::kRender, 11, "blend"},
        InFilm{10, "blend"}},
    RenderSetting{&RenderSettings::splat_size, &RenderChoices::splat_size,
        RealRange{0.05, 1}, // smaller splats fall between the pixels of most pictures
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--splat-size", "FACTOR",
            "Scale the radii of splats by FACTOR, to see single points (default {default}; {limits})"},
        InSceneFile{FileTable::kRender, 19, "splat_size"},
        InFilm{18, "splat_size", nullptr, true}},
    RenderSetting{&RenderSettings::relight, &RenderChoices::relight,
        OneOf{kSwitchNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--relight", "on|off",
            "Light Gaussian captures with the lights of the scene, as matte surfaces of their base colours, instead of showing the "
            "light that was captured (default {default})"},
        InSceneFile{FileTable::kRender, 18, "relight"},
        InFilm{17, "relight", nullptr, true}},
    RenderSetting{&RenderSettings::caustics, &RenderChoices::caustics,
        OneOf{kSwitchNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--caustics", "on|off",
            "Render caustics, light focused by glass and mirrors (default {default})"},
        InSceneFile{FileTable::kRender, 10, "caustics"},
        InFilm{11, "caustics"}},
    RenderSetting{&RenderSettings::reflectivity, &RenderChoices::reflectivity,
        RealRange{0, 1},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--reflectivity", "R",
            "Reflectivity of scans without a material in the scene file, from 0 (matte) to 1 (mirror) (default: each "
            "scan's own)"},
        InSceneFile{FileTable::kRender, 12, "reflectivity"},
        InFilm{12, "reflectivity"}},
    RenderSetting{&RenderSettings::color_by, &RenderChoices::color_by,
        AttributeWord{},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--color-by", "NAME",
            "Colour scans by {limits} (default {default}, the scan's own colours; scans of sites, interiors and "
            "surveys without colours default to height or intensity)"},
        InSceneFile{FileTable::kRender, 13, "color_by"},
        InFilm{13, "color_by", nullptr, true}},
    RenderSetting{&RenderSettings::color_map, &RenderChoices::color_map,
        OneOf{kColorMapNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--color-map", "NAME",
            "Colour map of --color-by: {limits} (default viridis; classes for class, scans for scan)"},
        InSceneFile{FileTable::kRender, 14, "color_map"},
        InFilm{14, "color_map", nullptr, true}},
    RenderSetting{&RenderSettings::color_range, &RenderChoices::color_range,
        RangeOfValues{},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--color-range", "LO,HI",
            "Values at the two ends of the colour map, {limits} (default: 1st to 99th percentile; for small integers "
            "the whole range)"},
        InSceneFile{FileTable::kRender, 15, "color_range"},
        InFilm{15, "color_range", nullptr, true}},
    RenderSetting{&RenderSettings::legend, &RenderChoices::legend,
        OneOf{kSwitchNames},
        OnCommandLine{HelpGroup::kLightAndSurfaces, "--legend", "on|off",
            "Draw a legend of --color-by in the corner of the picture (default: on in the window, off in PNGs; never "
            "in EXRs)"},
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

/// The value of a row's member in settings; empty if the scene decides it.
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

/// Sets the settings that choices contain.
void applyChoices(const RenderChoices& choices, RenderSettings& settings);
/// The choices that reproduce settings.
RenderChoices choicesOf(const RenderSettings& settings);

} // namespace pointrt
