// SPDX-License-Identifier: Apache-2.0
// The arrays of a film and the names of their channels in OpenEXR files, for writing and reading.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <type_traits>
#include <vector>

#include "runtime/image/exr_structure.h"
#include "runtime/image/film.h"

namespace pointrt {

/// When a film has a part, and when its file does.
enum class FilmGroup {
    kPicture,    ///< always, and in its file too
    kAlways,     ///< always in the film; optional in its file
    kLightParts, ///< if light components are requested
    kFirstHits,  ///< if first hits are requested
};

struct FilmPart {
    std::vector<std::string> channels; ///< in their order within a pixel
    FilmGroup group = FilmGroup::kAlways;
    const char* name = ""; ///< name of the film's array
};

inline bool isRequired(const FilmPart& part) { return part.group == FilmGroup::kPicture; }

// The macros that rows of FILM_PARTS name channels with.
#define CHANNELS(...) __VA_ARGS__
#define COLOR(layer) layer ".R", layer ".G", layer ".B"
#define VECTOR(layer) layer ".X", layer ".Y", layer ".Z"

constexpr std::size_t countOf(std::initializer_list<const char*> channels) { return channels.size(); }

/// Values per pixel of each array: film_values::ARRAY.
namespace film_values {
#define POINTRT_COUNT(array, Value, channels, group, nothing, source, view)                                            \
    constexpr std::size_t array = countOf({channels});
FILM_PARTS(POINTRT_COUNT)
#undef POINTRT_COUNT
} // namespace film_values

/// Calls visit(part, film.ARRAY) for every array; FilmType is Film or const Film.
template <typename FilmType, typename Visit>
void forEachFilmPart(FilmType& film, Visit&& visit) {
#define POINTRT_VISIT(array, Value, channels, group, nothing, source, view)                                            \
    visit(FilmPart{{channels}, FilmGroup::group, #array}, film.array);
    FILM_PARTS(POINTRT_VISIT)
#undef POINTRT_VISIT
}

#undef CHANNELS
#undef COLOR
#undef VECTOR

template <typename T>
constexpr ExrPixel exrPixelOf(const std::vector<T>&) {
    static_assert(std::is_same_v<T, float> || std::is_same_v<T, std::uint32_t>);
    return std::is_same_v<T, float> ? ExrPixel::kFloat : ExrPixel::kUint;
}

} // namespace pointrt
