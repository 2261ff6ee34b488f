// SPDX-License-Identifier: Apache-2.0
// Resumable films: OpenEXR pictures that also store the number of samples and the signature of the rendering.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/image/film.h"

namespace pointrt {

struct SavedFilm {
    Film film;                 ///< the means over samples
    std::uint32_t samples = 0; ///< per pixel, at least 1
    std::uint32_t seed = 0;
    std::string signature; ///< everything that must agree between the runs (film_signature.h); any text
};

/// Writes the film as writeExr does, with the string attributes pointrt.samples, pointrt.seed and
/// pointrt.signature. Throws Error kCannotWrite "PATH: reason".
void writeSavedFilm(const std::string& path, const SavedFilm& saved);

/// Throws Error kBadInput: why path is not a film that can be continued.
[[noreturn]] void refuseFilm(const std::string& path, const std::string& reason);

/// Reads back exactly what writeSavedFilm wrote; nothing if there is no file at path. Throws Error kBadInput "PATH:
/// reason" if the file was not written by it.
std::optional<SavedFilm> readSavedFilm(const std::string& path);

} // namespace pointrt
