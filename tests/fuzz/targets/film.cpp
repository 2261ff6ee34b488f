// SPDX-License-Identifier: Apache-2.0
// Films that --resume continues.
#include "runtime/render/film_file.h"
#include "runtime/render/film_resume.h"
#include "tests/fuzz/fuzz_target.h"

using namespace pointrt;

POINTRT_FUZZ_TARGET(film) {
    const fuzz::MemoryFile file(input);
    fuzz::expectReadOrRefused(file.path(), [&] {
        formToResume(file.path());
        const std::optional<SavedFilm> saved = readSavedFilm(file.path());
        RenderSettings settings;
        settings.width = saved->film.width;
        settings.height = saved->film.height;
        const std::optional<Film> film = filmToResume(file.path(), saved->signature, settings);
        mostSamples(*film);
    });
}
