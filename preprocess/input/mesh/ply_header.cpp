// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/ply_header.h"

#include <algorithm>
#include <initializer_list>
#include <optional>

#include "preprocess/ingest/table.h"

namespace pointrt {
namespace {

std::optional<Scalar> scalarOfName(std::string_view name) {
    struct Named {
        std::string_view name;
        Scalar type;
    };
    constexpr Named kNames[] = {
        {"char", Scalar::kI8},    {"int8", Scalar::kI8},     {"uchar", Scalar::kU8},   {"uint8", Scalar::kU8},
        {"short", Scalar::kI16},  {"int16", Scalar::kI16},   {"ushort", Scalar::kU16}, {"uint16", Scalar::kU16},
        {"int", Scalar::kI32},    {"int32", Scalar::kI32},   {"uint", Scalar::kU32},   {"uint32", Scalar::kU32},
        {"int64", Scalar::kI64},  {"uint64", Scalar::kU64},  {"float", Scalar::kF32},  {"float32", Scalar::kF32},
        {"double", Scalar::kF64}, {"float64", Scalar::kF64},
    };
    for (const Named& named : kNames)
        if (named.name == name) return named.type;
    return std::nullopt;
}

/// Header lines end in LF, CR LF or, when the first one does, in CR alone.
struct HeaderLines {
    std::string_view rest;
    bool cr_alone;

    explicit HeaderLines(std::string_view bytes) : rest(bytes) {
        const std::size_t end = bytes.find_first_of("\r\n");
        cr_alone = end != std::string_view::npos && bytes[end] == '\r' && bytes.substr(end + 1, 1) != "\n";
    }

    bool next(std::string_view& line) {
        if (rest.empty()) return false;
        const std::size_t length = std::min(rest.find_first_of(cr_alone ? "\r" : "\n"), rest.size());
        line = rest.substr(0, length);
        rest.remove_prefix(std::min(length + 1, rest.size()));
        return true;
    }
};

Scalar scalarType(const InputFile& input, std::string_view name) {
    const auto type = scalarOfName(name);
    if (!type) refuseLine(input, name.data(), fmt::format("unknown property type {}", inQuotes(name)));
    return *type;
}

void addElement(const InputFile& input, std::string_view line, PlyHeader& header) {
    PlyElement element;
    const char* const place = line.data();
    element.name = nextWord(line);
    const std::string_view count = nextWord(line);
    if (!wholeInteger(count, element.count))
        refuseLine(input, place, fmt::format("element {} has no valid count", inQuotes(element.name)));
    if (hasControls(element.name)) refuseLine(input, place, inQuotes(element.name) + " is not a valid element name");
    header.elements.push_back(std::move(element));
}

void addProperty(const InputFile& input, std::string_view line, PlyHeader& header) {
    const char* const place = line.data();
    if (header.elements.empty()) refuseLine(input, place, "property before any element");
    PlyProperty property;
    std::string_view type = nextWord(line);
    if (type == "list") {
        property.is_list = true;
        property.count_type = scalarType(input, nextWord(line));
        if (isReal(property.count_type)) refuseLine(input, place, "a list's count must be an integer");
        type = nextWord(line);
    }
    property.type = scalarType(input, type);
    property.name = nextWord(line);
    if (property.name.empty()) refuseLine(input, place, "property without a name");
    header.elements.back().properties.push_back(std::move(property));
}

void setFormat(const InputFile& input, std::string_view line, PlyHeader& header) {
    const char* const place = line.data();
    const std::string_view name = nextWord(line);
    if (name == "ascii")
        header.encoding = PlyEncoding::kAscii;
    else if (name == "binary_little_endian")
        header.encoding = PlyEncoding::kLittleEndian;
    else if (name == "binary_big_endian")
        header.encoding = PlyEncoding::kBigEndian;
    else
        refuseLine(input, place, fmt::format("unknown PLY format {}", inQuotes(name)));
}

/// "obj_info num_cols 512"; lines without a number are ignored.
void readInfo(std::string_view line, PlyHeader& header) {
    const std::string_view name = nextWord(line);
    if (name == "num_rows") wholeInteger(nextWord(line), header.grid_rows);
    if (name == "num_cols") wholeInteger(nextWord(line), header.grid_columns);
}

void parseLines(const InputFile& input, HeaderLines& lines, PlyHeader& header) {
    bool has_format = false;
    std::string_view line;
    while (lines.next(line)) {
        std::string_view rest = line;
        const std::string_view keyword = nextWord(rest);
        if (keyword == "format") {
            setFormat(input, rest, header);
            has_format = true;
        } else if (keyword == "element") {
            addElement(input, rest, header);
        } else if (keyword == "property") {
            addProperty(input, rest, header);
        } else if (keyword == "comment" && nextWord(rest) == "TextureFile") {
            header.textures.emplace_back(withoutBlanks(rest));
        } else if (keyword == "obj_info") {
            readInfo(rest, header);
        } else if (keyword == "end_header") {
            if (!has_format) refuse(input, "the PLY header has no format line");
            header.body = lines.rest.data();
            return;
        }
    }
    refuse(input, "the PLY header has no end_header line");
}

std::vector<Dimension> rolesOf(const PlyElement& vertex) {
    std::vector<Dimension> dimensions;
    for (const PlyProperty& property : vertex.properties)
        dimensions.push_back(property.is_list ? kIgnored : dimensionOfName(property.name));
    resolveDimensions(dimensions);
    return dimensions;
}

/// Gaussian-splat files have the constant terms of spherical harmonics instead of red, green, blue.
bool takeHarmonicColors(const PlyElement& vertex, std::vector<Dimension>& dimensions) {
    std::vector<Dimension> with_harmonics = dimensions;
    for (std::size_t i = 0; i < dimensions.size(); ++i) {
        const std::string& name = vertex.properties[i].name;
        if (name == "f_dc_0") with_harmonics[i] = kRed;
        if (name == "f_dc_1") with_harmonics[i] = kGreen;
        if (name == "f_dc_2") with_harmonics[i] = kBlue;
    }
    resolveDimensions(with_harmonics);
    if (hasColors(dimensions) || !hasColors(with_harmonics)) return false;
    dimensions = with_harmonics;
    return true;
}

bool hasAll(const PlyElement& element, std::initializer_list<std::string_view> names) {
    return std::all_of(names.begin(), names.end(), [&](std::string_view name) { return hasProperty(element, name); });
}

/// As written by the training code of "3D Gaussian Splatting for Real-Time Radiance Field Rendering" (Kerbl et al.,
/// 2023) and its successors, including 2D Gaussians, which have no scale_2, and nerfstudio's with red, green and blue
/// in place of f_dc; or packed.
PlyGaussians gaussiansOf(const PlyElement& vertex) {
    if (hasAll(vertex, {"packed_position", "packed_rotation", "packed_scale", "packed_color"}))
        return PlyGaussians::kPacked;
    const bool colored = hasAll(vertex, {"f_dc_0", "f_dc_1", "f_dc_2"}) || hasAll(vertex, {"red", "green", "blue"});
    const bool plain =
        hasAll(vertex, {"x", "y", "z", "opacity", "scale_0", "scale_1", "rot_0", "rot_1", "rot_2", "rot_3"});
    return plain && colored ? PlyGaussians::kPlain : PlyGaussians::kNone;
}

void resolveVertexDimensions(const InputFile& input, PlyHeader& header) {
    const auto isVertex = [](const PlyElement& element) { return element.name == "vertex"; };
    const auto vertices = std::count_if(header.elements.begin(), header.elements.end(), isVertex);
    if (vertices != 1) refuse(input, vertices == 0 ? "no vertex element" : "more than one vertex element");
    PlyElement& vertex = *std::find_if(header.elements.begin(), header.elements.end(), isVertex);
    header.gaussians = gaussiansOf(vertex);
    if (header.gaussians == PlyGaussians::kPacked) return;
    std::vector<Dimension> dimensions = rolesOf(vertex);
    if (!hasPositions(dimensions)) refuse(input, "the vertices have no x, y and z");
    header.harmonic_colors = takeHarmonicColors(vertex, dimensions);
    for (std::size_t i = 0; i < dimensions.size(); ++i) vertex.properties[i].dimension = dimensions[i];
}

/// ASCII values take at least two bytes, a digit and a separator.
std::size_t smallestSize(const PlyElement& element, PlyEncoding encoding) {
    std::size_t size = 0;
    for (const PlyProperty& property : element.properties)
        size +=
            encoding == PlyEncoding::kAscii ? 2 : scalarSize(property.is_list ? property.count_type : property.type);
    return size;
}

void checkPromises(const InputFile& input, bool salvages, PlyHeader& header) {
    const bool ascii = header.encoding == PlyEncoding::kAscii;
    // The last value of an ASCII file needs no separator.
    std::uint64_t left = static_cast<std::uint64_t>(input.end() - header.body) + (ascii ? 1 : 0);
    for (PlyElement& element : header.elements) {
        element.promised = element.count;
        const std::size_t size = smallestSize(element, header.encoding);
        if (salvages) element.count = std::min<std::uint64_t>(element.count, left / size);
        if (element.count > left / size)
            refuse(input,
                   ascii ? fmt::format(
                               "the header promises {} {}, but only {} bytes follow; --salvage reads the intact part",
                               element.count, pluralOf(element), left - 1)
                         : fmt::format("truncated: found {} of {} {}{}", left / size, element.count, pluralOf(element),
                                       left >= size ? "; --salvage reads the intact part" : ""));
        left -= element.count * size;
    }
}

} // namespace

PlyHeader readPlyHeader(const InputFile& input, bool salvages) {
    HeaderLines lines(input.bytes);
    std::string_view line;
    if (!lines.next(line) || nextWord(line) != "ply") refuse(input, "does not start with 'ply'");
    PlyHeader header;
    parseLines(input, lines, header);
    resolveVertexDimensions(input, header);
    // elements without properties take no bytes, so any number may be declared
    std::erase_if(header.elements, [](const PlyElement& element) { return element.properties.empty(); });
    checkPromises(input, salvages, header);
    return header;
}

bool hasProperty(const PlyElement& element, std::string_view name) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [&](const PlyProperty& property) { return property.name == name; });
}

const PlyElement& vertexElement(const PlyHeader& header) {
    return *std::find_if(header.elements.begin(), header.elements.end(),
                         [](const PlyElement& element) { return element.name == "vertex"; });
}

bool hasFaces(const PlyHeader& header) {
    return std::any_of(header.elements.begin(), header.elements.end(), [](const PlyElement& element) {
        return (element.name == "face" || element.name == "tristrips") && element.count > 0;
    });
}

std::string pluralOf(const PlyElement& element) {
    if (element.name == "vertex") return "vertices";
    if (element.name == "face") return "faces";
    return inQuotes(element.name) + " elements";
}

} // namespace pointrt
