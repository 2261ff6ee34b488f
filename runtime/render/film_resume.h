// SPDX-License-Identifier: Apache-2.0
// Going on with a film that was saved.
#pragma once

#include <optional>
#include <string>

#include "runtime/image/film.h"
#include "runtime/render/form_of_passes.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// The film saved at path, to be refined; nothing where there is no file. Its colours are put together from its layers:
/// they may have been denoised. Throws Error kBadInput "PATH: reason" where the file is no saved film, or of something
/// else than signature (film_signature.h) says, which is of settings.
std::optional<Film> filmToResume(const std::string& path, const std::string& signature, const RenderSettings& settings);

/// The most and the fewest samples of any pixel of film.
std::uint32_t mostSamples(const Film& film);
std::uint32_t fewestSamples(const Film& film);

/// The form of the passes that the film at path was begun in; none where there is no file. Throws Error as
/// readSavedFilm.
FormRequest formToResume(const std::string& path);

} // namespace pointrt
