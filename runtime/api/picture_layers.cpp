// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/picture_layers.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "format/base/error.h"
#include "runtime/image/film_parts.h"

namespace pointrt {
namespace {

bool isAmong(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void takeValues(std::vector<float>& values, PictureLayer& layer) { layer.floats = std::move(values); }
void takeValues(std::vector<std::uint32_t>& values, PictureLayer& layer) { layer.words = std::move(values); }

std::vector<PictureLayerKind> allKinds() {
    std::vector<PictureLayerKind> kinds;
    Film film;
    forEachFilmPart(film, [&](const FilmPart& part, const auto& values) {
        kinds.push_back({part.name, part.channels, exrPixelOf(values) == ExrPixel::kUint});
    });
    return kinds;
}

std::string knownLayers() {
    std::string names;
    for (const PictureLayerKind& kind : pictureLayers()) names += (names.empty() ? "" : ", ") + kind.name;
    return names;
}

void requireKnown(const std::string& name) {
    for (const PictureLayerKind& kind : pictureLayers())
        if (kind.name == name) return;
    throw Error{ExitCode::kBadUsage, "unknown layer \"" + name + "\"; known layers are " + knownLayers()};
}

} // namespace

const std::vector<PictureLayerKind>& pictureLayers() {
    static const std::vector<PictureLayerKind> kinds = allKinds();
    return kinds;
}

const PictureLayer& Picture::layer(const std::string& name) const {
    for (const PictureLayer& each : layers)
        if (each.kind.name == name) return each;
    throw TraceError(TraceError::Kind::kBadUsage, "the picture has no layer \"" + name + "\"");
}

bool wantsFirstHits(const std::vector<std::string>& layers) {
    for (const std::string& name : layers) requireKnown(name);
    bool wanted = false;
    Film film;
    forEachFilmPart(film, [&](const FilmPart& part, const auto&) {
        wanted |= part.group == FilmGroup::kFirstHits && isAmong(layers, part.name);
    });
    return wanted;
}

Picture pictureOf(Film film, const std::vector<std::string>& layers) {
    Picture picture{film.width, film.height, {}};
    auto kind = pictureLayers().begin();
    forEachFilmPart(film, [&](const FilmPart& part, auto& values) {
        if (isAmong(layers, part.name)) {
            picture.layers.push_back({*kind, {}, {}});
            takeValues(values, picture.layers.back());
        }
        ++kind;
    });
    return picture;
}

} // namespace pointrt
