// SPDX-License-Identifier: Apache-2.0
// A film that can be continued: the OpenEXR file that is the picture also says how far it is and what it is of.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/image/film.h"

namespace pointrt {

struct SavedFilm {
    Film film;                 ///< the means over samples
    std::uint32_t samples = 0; ///< a pixel, at least 1
    std::uint32_t seed = 0;
    std::string signature; ///< of all that must agree between the runs, any text
};

/// Writes what film has as writeExr does, with the string attributes pointrt.samples, pointrt.seed and
/// pointrt.signature. Throws Error kCannotWrite "PATH: reason".
void writeSavedFilm(const std::string& path, const SavedFilm& saved);

/// What writeSavedFilm wrote, exactly; nothing where there is no file at path.
/// Throws Error kBadInput "PATH: reason" where it is not such a file.
std::optional<SavedFilm> readSavedFilm(const std::string& path);

} // namespace pointrt
