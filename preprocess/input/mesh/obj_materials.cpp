// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/obj_materials.h"

#include <algorithm>
#include <cmath>

#include "preprocess/ingest/table.h"
#include "preprocess/input/mesh/picture.h"

namespace pointrt {
namespace {

/// Limits for one model, whose lines may name the same files again and again.
constexpr std::size_t kMostMaterials = 65536, kMostFiles = 256;

/// "-s 1 1 1 -clamp on name.png": options and their values precede the name, which may have blanks.
std::string textureName(std::string_view rest) {
    rest = withoutBlanks(rest);
    while (rest.starts_with('-')) {
        nextWord(rest);
        for (std::string_view after = rest;; rest = after) {
            const std::string_view word = nextWord(after);
            double value = 0;
            if (word != "on" && word != "off" && !wholeNumber(word, value)) break;
        }
        rest = withoutBlanks(rest);
    }
    return std::string(rest);
}

/// "0.8 0.4 0.2", in sRGB, as programs display it; false if it is not a colour in numbers.
bool takeColor(std::string_view rest, Rgb8& color) {
    for (std::uint8_t& channel : color) {
        double value = 0;
        if (!wholeNumber(nextWord(rest), value) || !std::isfinite(value)) return false;
        channel = static_cast<std::uint8_t>(std::clamp(value, 0.0, 1.0) * 255 + 0.5);
    }
    return true;
}

class MaterialReader {
public:
    MaterialReader(const InputFile& model, ObjMaterials& materials, Sink& sink)
        : model_(model), materials_(materials), sink_(sink) {}

    void read(const InputFile& file) {
        if (++materials_.files > kMostFiles)
            refuse(model_, fmt::format("names more than {} files of materials", kMostFiles));
        Lines lines{file.bytes, true};
        ObjMaterial* material = nullptr;
        for (std::string_view line; lines.next(line);) {
            const std::string keyword = lowerCase(nextWord(line)); // some programs write them in capitals
            if (keyword == "newmtl" && materials_.by_name.size() < kMostMaterials)
                material = &materials_.by_name[std::string(withoutBlanks(line))];
            else if (keyword == "kd" && material && material->picture == FacePaint::kNone)
                material->picture = takeColor(line, material->color) ? FacePaint::kPlain : FacePaint::kNone;
            else if (keyword == "map_kd" && material)
                takeTexture(textureName(line), *material);
        }
    }

private:
    void takeTexture(const std::string& name, ObjMaterial& material) {
        auto found = textures_.find(name);
        if (found == textures_.end()) found = textures_.emplace(name, addTexture(model_, name, sink_)).first;
        if (found->second) material.picture = *found->second;
    }

    const InputFile& model_;
    ObjMaterials& materials_;
    Sink& sink_;
    std::map<std::string, std::optional<std::uint32_t>> textures_;
};

} // namespace

void readObjMaterials(const InputFile& input, std::string_view names, ObjMaterials& materials, Sink& sink) {
    MaterialReader reader(input, materials, sink);
    names = withoutBlanks(names);
    if (const auto whole = openBeside(input, std::string(names))) return reader.read(*whole);
    for (std::string_view name = nextWord(names); !name.empty(); name = nextWord(names)) {
        if (const auto file = openBeside(input, std::string(name)))
            reader.read(*file);
        else
            sink.note(input, fmt::format("names the materials {}, which are not in its folder: its faces lack those "
                                         "colours",
                                         inQuotes(name)));
    }
}

} // namespace pointrt
