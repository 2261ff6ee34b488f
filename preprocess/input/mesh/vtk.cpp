// SPDX-License-Identifier: GPL-3.0-or-later
// Legacy files of VTK, as text or big-endian: https://docs.vtk.org/en/latest/vtk_file_formats
#include <algorithm>

#include "preprocess/ingest/formats.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/text.h"
#include "preprocess/input/mesh/vtk_piece.h"
#include "preprocess/input/mesh/vtp.h"

namespace pointrt {
namespace {

struct VtkType {
    std::string_view name;
    Scalar scalar;
};
constexpr VtkType kVtkTypes[] = {
    {"unsigned_char", Scalar::kU8},  {"char", Scalar::kI8},          {"unsigned_short", Scalar::kU16},
    {"short", Scalar::kI16},         {"unsigned_int", Scalar::kU32}, {"int", Scalar::kI32},
    {"unsigned_long", Scalar::kU64}, {"long", Scalar::kI64},         {"float", Scalar::kF32},
    {"double", Scalar::kF64},        {"vtkidtype", Scalar::kI32},    {"vtktypeint64", Scalar::kI64},
    {"vtktypeuint64", Scalar::kU64}};

class LegacyReader {
public:
    LegacyReader(const InputFile& input, Sink& sink) : input_(input), sink_(sink), rest_(input.bytes) {}

    void read() {
        readTitle();
        for (std::string_view line; nextLine(rest_, line);) {
            const std::string word = lowerCase(nextWord(line));
            if (word.empty()) continue;
            if (word == "cell_data") break; // nothing about points follows
            readSection(word, line);
        }
        if (!unread_.empty()) sink_.note(input_, "is read without its " + unread_);
        addVtkPiece(input_, piece_, Emptiness::kRefused, sink_);
    }

private:
    void readTitle() {
        std::string_view line;
        nextLine(rest_, line);
        nextLine(rest_, line);
        if (!nextLine(rest_, line)) refuse(input_, "truncated within the header");
        const std::string_view kind = nextWord(line);
        binary_ = lowerCase(kind) == "binary";
        if (!binary_ && lowerCase(kind) != "ascii")
            refuseLine(input_, line.data(), fmt::format("expected ASCII or BINARY, not {}", inQuotes(kind)));
    }

    void readSection(const std::string& word, std::string_view line) {
        if (word == "dataset") return checkDataSet(line);
        if (word == "points") return readPoints(line);
        if (word == "point_data") return void(in_point_data_ = count(line) == piece_.points);
        if (word == "polygons") return readCells(line, true);
        if (word == "vertices" || word == "lines" || word == "triangle_strips" || word == "cells")
            return skipCells(word, line);
        if (word == "cell_types") return void(takeArray("", Scalar::kI32, count(line), 1));
        if (word == "field") return readField(line);
        if (word == "metadata") return skipParagraph();
        if (word == "dimensions") return;
        readAttribute(word, line);
    }

    void checkDataSet(std::string_view line) {
        const std::string_view kind = nextWord(line);
        const std::string lower = lowerCase(kind);
        if (lower != "polydata" && lower != "unstructured_grid" && lower != "structured_grid")
            refuseLine(input_, line.data(), fmt::format("data set {} has no points of its own", inQuotes(kind)));
    }

    void readPoints(std::string_view line) {
        piece_.points = count(line);
        piece_.positions = takeArray("points", typeOf(line), piece_.points, 3);
    }

    /// Lists of indices, each preceded by its length; since version 5.1, two arrays of the lists' ends and of all
    /// indices.
    void readCells(std::string_view line, bool are_polygons) {
        const std::uint64_t cells = count(line), values = count(line);
        std::string_view after = rest_, next;
        nextLine(after, next);
        if (lowerCase(nextWord(next)) == "offsets") return readOffsets(cells, values, are_polygons);
        const FieldArray list = takeArray("", Scalar::kI32, values, 1);
        for (std::uint64_t at = 0; at < values && are_polygons;) {
            const double length = valueAt(list, at++);
            if (!(length >= 0 && length <= static_cast<double>(values - at)))
                refuse(input_, fmt::format("a polygon of {} corners is longer than their list", length));
            for (const std::uint64_t end = at + static_cast<std::uint64_t>(length); at < end; ++at)
                addCorner(input_, valueAt(list, at), piece_);
            piece_.ends.push_back(piece_.corners.size());
        }
    }

    void readOffsets(std::uint64_t offsets, std::uint64_t indices, bool are_polygons) {
        const FieldArray ends = takeNamedArray("offsets", offsets);
        const FieldArray corners = takeNamedArray("connectivity", indices);
        for (std::uint64_t i = 0; i < indices && are_polygons; ++i) addCorner(input_, valueAt(corners, i), piece_);
        for (std::uint64_t i = 1; i < offsets && are_polygons; ++i) {
            const double end = valueAt(ends, i);
            if (!(end >= valueAt(ends, i - 1) && valueAt(ends, i - 1) >= 0 && end <= static_cast<double>(indices)))
                refuse(input_, "the offsets of its polygons do not ascend within their list");
            piece_.ends.push_back(static_cast<std::size_t>(end));
        }
    }

    FieldArray takeNamedArray(std::string_view name, std::uint64_t values) {
        std::string_view line;
        while (nextLine(rest_, line)) {
            const std::string word = lowerCase(nextWord(line));
            if (word.empty()) continue;
            if (word == name) return takeArray("", typeOf(line), values, 1);
            break;
        }
        refuse(input_, fmt::format("has no array {} where one must follow", name));
    }

    void skipCells(const std::string& word, std::string_view line) {
        readCells(line, false);
        if (word == "triangle_strips" || word == "cells") unread_ += (unread_.empty() ? "" : " and ") + word;
    }

    /// "FIELD name arrays", then "name components tuples type" and the values of each.
    void readField(std::string_view line) {
        nextWord(line);
        const std::uint64_t arrays = count(line);
        for (std::uint64_t i = 0; i < arrays && nextLine(rest_, line);) {
            const std::string name(nextWord(line));
            if (name.empty()) continue;
            if (name == "METADATA") {
                skipParagraph();
                continue;
            }
            const std::uint64_t components = count(line), tuples = count(line);
            const FieldArray array = takeArray(name, typeOf(line), tuples, components);
            keep(array, tuples);
            ++i;
        }
    }

    void readAttribute(const std::string& word, std::string_view line) {
        const char* const place = line.data();
        const std::string name(nextWord(line));
        if (word == "lookup_table") return void(takeArray("", tableType(), count(line), 4));
        if (word == "color_scalars")
            return keep(takeArray("rgb", tableType(), piece_.points, count(line)), piece_.points);
        std::uint64_t components = 3;
        if (word == "texture_coordinates") components = count(line);
        if (word == "tensors") components = 9;
        const bool is_single = word == "scalars" || word == "global_ids" || word == "pedigree_ids";
        if (!is_single && word != "normals" && word != "vectors" && word != "texture_coordinates" && word != "tensors")
            refuseLine(input_, place, fmt::format("unknown keyword {}", inQuotes(word)));
        const Scalar type = typeOf(line);
        std::string_view more = line;
        if (is_single) components = nextWord(more).empty() ? 1 : count(line);
        if (word == "scalars") skipTableName();
        keep(takeArray(word == "normals" ? "normals" : name, type, piece_.points, components), piece_.points);
    }

    /// Tables of colours are bytes, or reals in [0, 1] in text.
    Scalar tableType() const { return binary_ ? Scalar::kU8 : Scalar::kF32; }

    void skipTableName() {
        std::string_view after = rest_, line;
        if (nextLine(after, line) && lowerCase(nextWord(line)) == "lookup_table") rest_ = after;
    }

    void skipParagraph() {
        std::string_view line;
        while (nextLine(rest_, line)) {
            std::string_view words = line;
            if (nextWord(words).empty()) return;
        }
    }

    void keep(const FieldArray& array, std::uint64_t tuples) {
        if (in_point_data_ && tuples == piece_.points) piece_.fields.push_back(array);
    }

    std::uint64_t count(std::string_view& line) const {
        const std::string_view word = nextWord(line);
        std::uint64_t value = 0;
        if (!wholeInteger(word, value))
            refuseLine(input_, word.data(), fmt::format("expected a number, not {}", inQuotes(word)));
        return value;
    }

    Scalar typeOf(std::string_view& line) const {
        const std::string_view word = nextWord(line);
        const std::string lower = lowerCase(word);
        for (const VtkType& type : kVtkTypes)
            if (type.name == lower) return type.scalar;
        refuseLine(input_, word.data(), fmt::format("{} is not a type of numbers", inQuotes(word)));
    }

    FieldArray takeArray(const std::string& name, Scalar type, std::uint64_t tuples, std::uint64_t components) {
        constexpr std::uint64_t kMostComponents = 1 << 16;
        const std::uint64_t size = scalarSize(type);
        if (components == 0 || components > kMostComponents)
            refuse(input_, fmt::format("an array has {} components", components));
        // a number takes two bytes of text, a digit and a blank; the last needs no blank
        const std::uint64_t room = (binary_ ? rest_.size() / size : (rest_.size() + 1) / 2) / components;
        if (tuples > room)
            refuse(input_, fmt::format("truncated: {} values of {} are promised, but only {} bytes follow",
                                       tuples * components, name.empty() ? "cells" : inQuotes(name), rest_.size()));
        FieldArray array = denseField(name, type, static_cast<std::uint32_t>(components), rest_.data());
        array.swapped = binary_;
        if (binary_)
            rest_.remove_prefix(tuples * components * size);
        else
            array.first = piece_.owned.emplace_back(takeNumbers(input_, rest_, type, tuples * components)).data();
        return array;
    }

    const InputFile& input_;
    Sink& sink_;
    std::string_view rest_;
    VtkPiece piece_;
    bool binary_ = false, in_point_data_ = false;
    std::string unread_;
};

constexpr std::string_view kLegacyMark = "# vtk DataFile";

bool isVtk(std::string_view bytes) { return bytes.starts_with(kLegacyMark) || isVtp(bytes); }

void readVtk(const InputFile& input, Sink& sink) {
    if (isVtp(input.bytes)) return readVtp(input, sink);
    if (!input.bytes.starts_with(kLegacyMark)) refuse(input, "starts neither with '# vtk DataFile' nor with <VTKFile>");
    LegacyReader(input, sink).read();
}

} // namespace

const FormatReader readers::kVtk{.isStart = isVtk, .read = readVtk};

} // namespace pointrt
