// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/film_resume.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "format/base/error.h"
#include "runtime/image/film_parts.h"
#include "runtime/render/film_file.h"
#include "runtime/render/film_signature.h"
#include "runtime/render/frame_limits.h"

namespace pointrt {
namespace {

void requireAllParts(const std::string& path, Film& film) {
    forEachFilmPart(film, [&](const FilmPart& part, auto& values) {
        if (values.empty()) refuseFilm(path, "it has no channel " + part.channels.front());
    });
}

/// Rows are rendered as a whole, so all pixels of a row have the same number of samples.
void requireRowCounts(const std::string& path, const Film& film) {
    for (std::size_t i = 0; i < film.samples.size(); ++i) {
        const float count = film.samples[i];
        if (!(count >= 0 && count <= kMaxSpp) || count != std::floor(count) ||
            count != film.samples[i / film.width * film.width])
            refuseFilm(path, "its channel samples is damaged");
    }
}

void colorsFromLayers(Film& film) {
    for (std::size_t i = 0; i < film.samples.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = 3 * i + c;
            film.rgba[4 * i + c] = film.direct[at] + film.indirect[at] + film.caustic[at];
        }
}

} // namespace

std::optional<Film> filmToResume(const std::string& path, const std::string& signature,
                                 const RenderSettings& settings) {
    std::optional<SavedFilm> saved = readSavedFilm(path);
    if (!saved) return std::nullopt;
    const std::string difference = signatureDifference(saved->signature, signature);
    if (!difference.empty()) refuseFilm(path, difference);
    if (saved->film.width != settings.width || saved->film.height != settings.height)
        refuseFilm(path, "its size is wrong");
    requireAllParts(path, saved->film);
    requireRowCounts(path, saved->film);
    colorsFromLayers(saved->film);
    return std::move(saved->film);
}

FormRequest formToResume(const std::string& path) {
    const std::optional<SavedFilm> saved = readSavedFilm(path);
    return saved ? FormRequest(formOf(saved->signature)) : std::nullopt;
}

std::uint32_t mostSamples(const Film& film) {
    return static_cast<std::uint32_t>(*std::max_element(film.samples.begin(), film.samples.end()));
}

std::uint32_t fewestSamples(const Film& film) {
    return static_cast<std::uint32_t>(*std::min_element(film.samples.begin(), film.samples.end()));
}

} // namespace pointrt
