// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront OBJ: positions, vertex colours after them, normals, faces.
#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/table.h"
#include "preprocess/input/mesh/obj_materials.h"

namespace pointrt {
namespace {

struct Model {
    std::vector<Vec3d> positions;
    std::vector<std::array<double, 3>> colors; ///< empty, or as long as positions
    std::vector<Vec3f> normals;                ///< vn lines
    std::vector<Vec3f>
        normal_sums; ///< sums of the normals that faces assign to each position; empty, or as long as positions
    std::vector<std::uint32_t> corners;      ///< of all polygons
    std::vector<std::uint32_t> polygon_ends; ///< indices into corners

    ObjMaterials materials;
    bool has_materials = false;                 ///< an mtllib line precedes: only then are the next members set
    std::vector<Eigen::Vector2f> places;        ///< vt lines
    std::vector<Eigen::Vector2f> corner_places; ///< of the corners; (0, 0) if a face names none
    std::vector<ObjMaterial> polygon_materials; ///< empty, or as long as polygon_ends
    ObjMaterial material;                       ///< of the next faces
    std::string unknown_material;               ///< the first that no file defines
};

/// Reads lines; one that ends in a backslash continues on the next.
struct ObjLines {
    std::string_view rest;
    std::string joined;
    const char* place = nullptr; ///< where the line starts in the input

    bool next(std::string_view& line) {
        place = rest.data();
        if (!nextLine(rest, line)) return false;
        if (!line.ends_with('\\')) return true;
        joined.clear();
        bool more = true;
        while (more && line.ends_with('\\')) {
            joined.append(line.substr(0, line.size() - 1)).push_back(' ');
            more = nextLine(rest, line);
        }
        if (more) joined.append(line);
        line = joined;
        return true;
    }
};

/// Parses up to `most` numbers and returns their count.
std::size_t parseNumbers(const InputFile& input, const char* place, std::string_view line, double* values,
                         std::size_t most) {
    std::size_t count = 0;
    for (; count < most; ++count) {
        const std::string_view word = nextWord(line);
        if (word.empty() || word[0] == '#') break;
        if (!wholeNumber(word, values[count]))
            refuseLine(input, place, fmt::format("{} is not a number", inQuotes(word)));
    }
    if (count < 3) refuseLine(input, place, "expected 3 numbers");
    return count;
}

/// "v x y z [w]" or "v x y z r g b [a]".
void addPosition(const InputFile& input, const char* place, std::string_view line, Model& model) {
    constexpr double kGreyShare = 200 / 255.0;
    double values[7] = {};
    const std::size_t count = parseNumbers(input, place, line, values, 7);
    const bool colored = count >= 6;
    if (colored && model.colors.empty())
        model.colors.assign(model.positions.size(), {kGreyShare, kGreyShare, kGreyShare});
    model.positions.emplace_back(values[0], values[1], values[2]);
    if (colored)
        model.colors.push_back({values[3], values[4], values[5]});
    else if (!model.colors.empty())
        model.colors.push_back({kGreyShare, kGreyShare, kGreyShare});
}

void addNormal(const InputFile& input, const char* place, std::string_view line, Model& model) {
    double values[3] = {};
    parseNumbers(input, place, line, values, 3);
    const Vec3d normal(values[0], values[1], values[2]);
    const bool usable = normal.allFinite() && normal.squaredNorm() > 0;
    model.normals.push_back(usable ? Vec3f(normal.normalized().cast<float>()) : Vec3f(Vec3f::Zero()));
}

/// Converts an index that is one-based, or negative from the newest, to an index below count.
std::uint32_t resolve(const InputFile& input, const char* place, std::string_view word, std::size_t count,
                      const char* what) {
    std::int64_t number = 0;
    if (!wholeInteger(word, number)) refuseLine(input, place, fmt::format("{} is not an index", inQuotes(word)));
    const std::int64_t index = number > 0 ? number - 1 : number < 0 ? number + static_cast<std::int64_t>(count) : -1;
    if (index < 0 || index >= static_cast<std::int64_t>(count))
        refuseLine(input, place, fmt::format("{} index {} is out of range ({} defined so far)", what, number, count));
    return static_cast<std::uint32_t>(index);
}

/// "vt u [v [w]]"; anything but a number counts as 0.
void addPlace(std::string_view line, Model& model) {
    double values[2] = {};
    for (double& value : values)
        if (!wholeNumber(nextWord(line), value)) value = 0;
    model.places.emplace_back(static_cast<float>(values[0]), static_cast<float>(values[1]));
}

/// The place in the texture that a corner names; (0, 0) if it names none that exists.
Eigen::Vector2f placeOf(std::string_view word, const Model& model) {
    std::int64_t number = 0;
    const auto count = static_cast<std::int64_t>(model.places.size());
    if (!wholeInteger(word, number)) return Eigen::Vector2f::Zero();
    const std::int64_t index = number > 0 ? number - 1 : number + count;
    return index >= 0 && index < count ? model.places[static_cast<std::size_t>(index)] : Eigen::Vector2f::Zero();
}

void useMaterial(std::string_view name, Model& model) {
    const auto found = model.materials.by_name.find(name);
    model.material = found != model.materials.by_name.end() ? found->second : ObjMaterial{};
    if (found == model.materials.by_name.end() && model.unknown_material.empty()) model.unknown_material = name;
}

/// A corner is "v", "v/vt", "v//vn" or "v/vt/vn".
void addCorner(const InputFile& input, const char* place, std::string_view word, Model& model) {
    const std::size_t slash = word.find('/');
    const std::uint32_t vertex = resolve(input, place, word.substr(0, slash), model.positions.size(), "vertex");
    model.corners.push_back(vertex);
    if (model.has_materials) {
        const std::string_view after = slash == std::string_view::npos ? "" : word.substr(slash + 1);
        model.corner_places.push_back(placeOf(after.substr(0, after.find('/')), model));
    }
    if (slash == std::string_view::npos) return;
    const std::size_t second = word.find('/', slash + 1);
    if (second == std::string_view::npos || second + 1 == word.size()) return;
    const std::uint32_t normal = resolve(input, place, word.substr(second + 1), model.normals.size(), "normal");
    if (model.normal_sums.size() < model.positions.size())
        model.normal_sums.resize(model.positions.size(), Vec3f::Zero());
    model.normal_sums[vertex] += model.normals[normal];
}

void addFace(const InputFile& input, const char* place, std::string_view line, Model& model) {
    for (std::string_view word = nextWord(line); !word.empty() && word[0] != '#'; word = nextWord(line))
        addCorner(input, place, word, model);
    if (model.corners.size() > kNoSensor) refuseLine(input, place, "more than 4294967295 face corners");
    model.polygon_ends.push_back(static_cast<std::uint32_t>(model.corners.size()));
    if (model.has_materials) model.polygon_materials.push_back(model.material);
}

void addMaterials(const InputFile& input, std::string_view names, Model& model, Sink& sink) {
    readObjMaterials(input, names, model.materials, sink);
    model.has_materials = true;
    model.corner_places.resize(model.corners.size(), Eigen::Vector2f::Zero());
    model.polygon_materials.resize(model.polygon_ends.size());
}

Model parseModel(const InputFile& input, Sink& sink) {
    Model model;
    ObjLines lines{input.bytes, {}};
    std::string_view line;
    while (lines.next(line)) {
        const std::string_view keyword = nextWord(line);
        if (keyword == "v")
            addPosition(input, lines.place, line, model);
        else if (keyword == "vn")
            addNormal(input, lines.place, line, model);
        else if (keyword == "f")
            addFace(input, lines.place, line, model);
        else if (keyword == "vt" && model.has_materials)
            addPlace(line, model);
        else if (keyword == "mtllib")
            addMaterials(input, line, model, sink);
        else if (keyword == "usemtl" && model.has_materials)
            useMaterial(withoutBlanks(line), model);
    }
    return model;
}

/// Normals of the vertices: as faces assign them, or one per vertex if no face does and the counts agree.
const std::vector<Vec3f>* vertexNormals(Model& model) {
    if (!model.normal_sums.empty()) {
        model.normal_sums.resize(model.positions.size(), Vec3f::Zero());
        return &model.normal_sums;
    }
    return model.normals.size() == model.positions.size() && !model.normals.empty() ? &model.normals : nullptr;
}

void addVertices(const Model& model, const std::vector<Vec3f>* normals, Sink& sink) {
    Row row{};
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            row[kX + axis] = model.positions[i][axis];
            if (normals) row[kNormalX + axis] = (*normals)[i][axis];
            if (!model.colors.empty()) row[kRed + axis] = model.colors[i][axis];
        }
        sink.addVertex(row);
    }
}

/// Plain colours of materials are ignored if vertices have colours.
void addPolygons(const Model& model, Sink& sink) {
    std::uint32_t begin = 0;
    for (std::size_t i = 0; i < model.polygon_ends.size(); ++i) {
        const std::uint32_t count = model.polygon_ends[i] - begin;
        PolygonPaint color;
        if (model.has_materials) {
            const ObjMaterial& material = model.polygon_materials[i];
            if (model.colors.empty() || material.picture != FacePaint::kPlain) color.picture = material.picture;
            color.color = material.color;
            color.places = std::span(model.corner_places).subspan(begin, count);
        }
        sink.addPolygon(std::span(model.corners).subspan(begin, count), color);
        begin = model.polygon_ends[i];
    }
}

/// "v" or "vn" and a number; other lines may come before.
bool isVertexLine(std::string_view line, bool) {
    const std::string_view word = nextWord(line);
    double value = 0;
    return (word == "v" || word == "vn") && wholeNumber(nextWord(line), value);
}

void readObj(const InputFile& input, Sink& sink) {
    Model model = parseModel(input, sink);
    const std::vector<Vec3f>* const normals = vertexNormals(model);
    ScanTraits traits;
    traits.vertices = model.positions.size();
    traits.normals = normals != nullptr;
    traits.colors = !model.colors.empty();
    traits.color_scale = ColorScale::kReal;
    sink.beginScan(input, traits);
    addVertices(model, normals, sink);
    addPolygons(model, sink);
    if (!model.unknown_material.empty())
        sink.note(input, fmt::format("uses the material {}, which no file defines", inQuotes(model.unknown_material)));
    sink.finishScan(input);
}

} // namespace

const FormatReader readers::kObj{.isLine = isVertexLine, .read = readObj};

} // namespace pointrt
