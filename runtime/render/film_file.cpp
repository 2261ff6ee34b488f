// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/film_file.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <type_traits>

#include "format/base/error.h"
#include "runtime/image/exr_read.h"
#include "runtime/image/film_parts.h"
#include "runtime/image/image_exr.h"

namespace pointrt {
namespace {

constexpr const char *kSamples = "pointrt.samples", *kSeed = "pointrt.seed", *kSignature = "pointrt.signature";

const std::string& textOf(const std::string& path, const ExrPicture& picture, const char* name) {
    const auto found = picture.texts.find(name);
    if (found == picture.texts.end()) refuseFilm(path, std::string("it has no ") + name);
    return found->second;
}

std::uint32_t numberOf(const std::string& path, const ExrPicture& picture, const char* name) {
    const std::string& text = textOf(path, picture, name);
    std::uint32_t number = 0;
    const char* end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, number);
    if (parsed.ec != std::errc{} || parsed.ptr != end) refuseFilm(path, std::string(name) + " is not a number");
    return number;
}

/// The planes of type T.
template <typename T>
const auto& planesOf(const ExrPicture& picture) {
    if constexpr (std::is_same_v<T, float>)
        return picture.floats;
    else
        return picture.words;
}

/// Interleaves the planes of a part; leaves values empty if the file has no such planes.
template <typename T>
void readPart(const std::string& path, const ExrPicture& picture, const FilmPart& part, std::vector<T>& values) {
    const auto& planes = planesOf<T>(picture);
    const auto has = [&](const std::string& name) { return planes.count(name) != 0; };
    if (!isRequired(part) && std::none_of(part.channels.begin(), part.channels.end(), has)) return;
    const std::size_t stride = part.channels.size();
    values.resize(stride * picture.width * picture.height);
    for (std::size_t c = 0; c < stride; ++c) {
        const auto plane = planes.find(part.channels[c]);
        if (plane == planes.end()) refuseFilm(path, "it has no channel " + part.channels[c]);
        for (std::size_t i = 0; i < plane->second.size(); ++i) values[i * stride + c] = plane->second[i];
    }
}

} // namespace

void writeSavedFilm(const std::string& path, const SavedFilm& saved) {
    const ExrText texts[] = {
        {kSamples, std::to_string(saved.samples)}, {kSeed, std::to_string(saved.seed)}, {kSignature, saved.signature}};
    writeExr(path, saved.film, texts);
}

void refuseFilm(const std::string& path, const std::string& reason) {
    throw Error{ExitCode::kBadInput, path + ": cannot be resumed: " + reason};
}

std::optional<SavedFilm> readSavedFilm(const std::string& path) {
    std::error_code failure;
    if (std::filesystem::status(path, failure).type() == std::filesystem::file_type::not_found) return std::nullopt;
    const ExrPicture picture = readExr(path, ExrKind::kFilm);
    SavedFilm saved;
    saved.samples = numberOf(path, picture, kSamples);
    if (saved.samples == 0) refuseFilm(path, "it holds no samples");
    saved.seed = numberOf(path, picture, kSeed);
    saved.signature = textOf(path, picture, kSignature);
    saved.film.width = picture.width;
    saved.film.height = picture.height;
    forEachFilmPart(saved.film, [&](const FilmPart& part, auto& values) { readPart(path, picture, part, values); });
    return saved;
}

} // namespace pointrt
