// SPDX-License-Identifier: Apache-2.0
// Resuming a saved film.
#pragma once

#include <optional>
#include <string>

#include "runtime/image/film.h"
#include "runtime/render/kernel_form.h"
#include "runtime/scene/render_settings.h"

namespace pointrt {

/// The film saved at path; nothing if there is no file. Recomputes its colours from its layers, as they may have been
/// denoised. Throws Error kBadInput "PATH: reason" if the file is not a saved film or does not match signature
/// (film_signature.h) and settings.
std::optional<Film> filmToResume(const std::string& path, const std::string& signature, const RenderSettings& settings);

/// The most and the fewest samples of any pixel of film.
std::uint32_t mostSamples(const Film& film);
std::uint32_t fewestSamples(const Film& film);

/// The kernel form in which the film at path was started; none if there is no file. Throws Error as readSavedFilm.
FormRequest formToResume(const std::string& path);

} // namespace pointrt
