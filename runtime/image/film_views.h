// SPDX-License-Identifier: Apache-2.0
// The parts of a film that the window can show, by number.
#pragma once

#include <array>
#include <cstdint>

#include "runtime/image/film_parts.h"

namespace pointrt {

/// How a part is shown.
enum class ShownAs {
    kLight,  ///< exposed and tone mapped
    kShare,  ///< a fraction of light: not exposed
    kNumber, ///< unchanged
};

struct FilmView {
    FilmGroup group = FilmGroup::kAlways; ///< group of the part
    std::uint32_t number = 0;
    const char* label = nullptr; ///< null: not shown
    ShownAs as = ShownAs::kLight;
};

#define POINTRT_VIEW(array, Value, channels, group, nothing, source, view) view
#define NOT_SHOWN
#define SHOWN(number, NAME, label, how, function) SHOWN_##NAME = number,
enum : std::uint32_t { FILM_PARTS(POINTRT_VIEW) };
#undef SHOWN
#define SHOWN(number, NAME, label, how, function) 1 +
constexpr std::size_t kFilmViewCount = FILM_PARTS(POINTRT_VIEW) 0;
#undef SHOWN
#undef NOT_SHOWN
#undef POINTRT_VIEW

/// All of them, by number.
constexpr auto kFilmViews = [] {
#define POINTRT_VIEW(array, Value, channels, group, nothing, source, view) FilmView{FilmGroup::group view},
#define NOT_SHOWN
#define SHOWN(number, NAME, label, how, function) , number, label, ShownAs::how
    std::array<FilmView, kFilmViewCount> views;
    for (const FilmView& each : {FILM_PARTS(POINTRT_VIEW)})
        if (each.label) views.at(each.number) = each;
#undef SHOWN
#undef NOT_SHOWN
#undef POINTRT_VIEW
    return views;
}();

constexpr bool areComplete(const std::array<FilmView, kFilmViewCount>& views) {
    for (const FilmView& view : views)
        if (!view.label) return false;
    return true;
}
static_assert(areComplete(kFilmViews), "parts that are shown must be numbered from 0, without gaps or duplicates");

} // namespace pointrt
