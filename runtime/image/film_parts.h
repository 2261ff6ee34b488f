// SPDX-License-Identifier: Apache-2.0
// A film's arrays and what their channels are called in OpenEXR files; one list for writing and reading.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "runtime/image/exr_structure.h"
#include "runtime/image/film.h"

namespace pointrt {

struct FilmPart {
    std::vector<std::string> channels; ///< as they follow each other within a pixel
    bool required = false;
};

inline FilmPart colorPart(const std::string& layer) { return {{layer + ".R", layer + ".G", layer + ".B"}}; }
inline FilmPart vectorPart(const std::string& layer) { return {{layer + ".X", layer + ".Y", layer + ".Z"}}; }

/// Calls visit(part, film.ARRAY) for every array; FilmType is Film or const Film.
template <typename FilmType, typename Visit>
void forEachFilmPart(FilmType& film, Visit&& visit) {
    visit(FilmPart{{"R", "G", "B", "A"}, true}, film.rgba);
    visit(FilmPart{{"Z"}}, film.depth);
    visit(vectorPart("N"), film.normal);
    visit(vectorPart("P"), film.position);
    visit(colorPart("direct"), film.direct);
    visit(colorPart("indirect"), film.indirect);
    visit(colorPart("caustic"), film.caustic);
    visit(colorPart("albedo"), film.albedo);
    visit(FilmPart{{"id.splat"}}, film.splat_id);
    visit(FilmPart{{"id.instance"}}, film.instance_id);
    visit(FilmPart{{"samples"}}, film.samples);
    visit(FilmPart{{"variance"}}, film.variance);
}

template <typename T>
constexpr ExrPixel exrPixelOf(const std::vector<T>&) {
    static_assert(std::is_same_v<T, float> || std::is_same_v<T, std::uint32_t>);
    return std::is_same_v<T, float> ? ExrPixel::kFloat : ExrPixel::kUint;
}

} // namespace pointrt
