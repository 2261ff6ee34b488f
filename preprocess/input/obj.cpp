// SPDX-License-Identifier: GPL-3.0-or-later
// Wavefront OBJ: positions, vertex colours after them, normals, faces.
#include "preprocess/ingest/text.h"
#include "preprocess/input/formats.h"

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

/// A corner is "v", "v/vt", "v//vn" or "v/vt/vn".
void addCorner(const InputFile& input, const char* place, std::string_view word, Model& model) {
    const std::size_t slash = word.find('/');
    const std::uint32_t vertex = resolve(input, place, word.substr(0, slash), model.positions.size(), "vertex");
    model.corners.push_back(vertex);
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
}

Model parseModel(const InputFile& input) {
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

/// "v" or "vn" and a number: files may start with others.
bool isVertexLine(std::string_view line, bool) {
    const std::string_view word = nextWord(line);
    double value = 0;
    return (word == "v" || word == "vn") && wholeNumber(nextWord(line), value);
}

void readObj(const InputFile& input, Sink& sink) {
    Model model = parseModel(input);
    const std::vector<Vec3f>* const normals = vertexNormals(model);
    ScanTraits traits;
    traits.vertices = model.positions.size();
    traits.normals = normals != nullptr;
    traits.colors = !model.colors.empty();
    traits.color_scale = ColorScale::kReal;
    sink.beginScan(input, traits);
    addVertices(model, normals, sink);
    std::uint32_t begin = 0;
    for (const std::uint32_t end : model.polygon_ends) {
        sink.addPolygon(std::span(model.corners).subspan(begin, end - begin));
        begin = end;
    }
    sink.finishScan(input);
}

} // namespace

const FormatReader readers::kObj{.isLine = isVertexLine, .read = readObj};

} // namespace pointrt
