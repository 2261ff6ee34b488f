// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/ply_header.h"

#include <algorithm>
#include <initializer_list>
#include <optional>

#include "preprocess/input/text.h"

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

Scalar scalarType(const Source& source, std::string_view name) {
    const auto type = scalarOfName(name);
    if (!type) refuseLine(source, name.data(), fmt::format("unknown property type {}", inQuotes(name)));
    return *type;
}

void addElement(const Source& source, std::string_view line, PlyHeader& header) {
    PlyElement element;
    const char* const place = line.data();
    element.name = nextWord(line);
    const std::string_view count = nextWord(line);
    if (!wholeInteger(count, element.count))
        refuseLine(source, place, fmt::format("element {} has no valid count", inQuotes(element.name)));
    if (hasControls(element.name)) refuseLine(source, place, inQuotes(element.name) + " is no name of an element");
    header.elements.push_back(std::move(element));
}

void addProperty(const Source& source, std::string_view line, PlyHeader& header) {
    const char* const place = line.data();
    if (header.elements.empty()) refuseLine(source, place, "property before any element");
    PlyProperty property;
    std::string_view type = nextWord(line);
    if (type == "list") {
        property.is_list = true;
        property.count_type = scalarType(source, nextWord(line));
        if (isReal(property.count_type)) refuseLine(source, place, "a list's count must be an integer");
        type = nextWord(line);
    }
    property.type = scalarType(source, type);
    property.name = nextWord(line);
    if (property.name.empty()) refuseLine(source, place, "property without a name");
    header.elements.back().properties.push_back(std::move(property));
}

void setFormat(const Source& source, std::string_view line, PlyHeader& header) {
    const char* const place = line.data();
    const std::string_view name = nextWord(line);
    if (name == "ascii")
        header.encoding = PlyEncoding::kAscii;
    else if (name == "binary_little_endian")
        header.encoding = PlyEncoding::kLittleEndian;
    else if (name == "binary_big_endian")
        header.encoding = PlyEncoding::kBigEndian;
    else
        refuseLine(source, place, fmt::format("unknown PLY format {}", inQuotes(name)));
}

/// "obj_info num_cols 512"; what no number follows is for others.
void readInfo(std::string_view line, PlyHeader& header) {
    const std::string_view name = nextWord(line);
    if (name == "num_rows") wholeInteger(nextWord(line), header.grid_rows);
    if (name == "num_cols") wholeInteger(nextWord(line), header.grid_columns);
}

void parseLines(const Source& source, HeaderLines& lines, PlyHeader& header) {
    bool has_format = false;
    std::string_view line;
    while (lines.next(line)) {
        std::string_view rest = line;
        const std::string_view keyword = nextWord(rest);
        if (keyword == "format") {
            setFormat(source, rest, header);
            has_format = true;
        } else if (keyword == "element") {
            addElement(source, rest, header);
        } else if (keyword == "property") {
            addProperty(source, rest, header);
        } else if (keyword == "obj_info") {
            readInfo(rest, header);
        } else if (keyword == "end_header") {
            if (!has_format) refuse(source, "the PLY header has no format line");
            header.body = lines.rest.data();
            return;
        }
    }
    refuse(source, "the PLY header has no end_header line");
}

std::vector<Role> rolesOf(const PlyElement& vertex) {
    std::vector<Role> roles;
    for (const PlyProperty& property : vertex.properties)
        roles.push_back(property.is_list ? kIgnored : roleOfName(property.name));
    settleRoles(roles);
    return roles;
}

/// Gaussian-splat files have no red, green, blue but the constant terms of spherical harmonics.
bool takeHarmonicColors(const PlyElement& vertex, std::vector<Role>& roles) {
    std::vector<Role> with_harmonics = roles;
    for (std::size_t i = 0; i < roles.size(); ++i) {
        const std::string& name = vertex.properties[i].name;
        if (name == "f_dc_0") with_harmonics[i] = kRed;
        if (name == "f_dc_1") with_harmonics[i] = kGreen;
        if (name == "f_dc_2") with_harmonics[i] = kBlue;
    }
    settleRoles(with_harmonics);
    if (hasColors(roles) || !hasColors(with_harmonics)) return false;
    roles = with_harmonics;
    return true;
}

bool hasProperty(const PlyElement& element, std::string_view name) {
    return std::any_of(element.properties.begin(), element.properties.end(),
                       [&](const PlyProperty& property) { return property.name == name; });
}

bool hasAll(const PlyElement& element, std::initializer_list<std::string_view> names) {
    return std::all_of(names.begin(), names.end(), [&](std::string_view name) { return hasProperty(element, name); });
}

/// As the training code of "3D Gaussian Splatting for Real-Time Radiance Field Rendering" (Kerbl and others, 2023) and
/// those after it write them, 2D ones included, which have no scale_2; or packed.
PlyGaussians gaussiansOf(const PlyElement& vertex) {
    if (hasAll(vertex, {"packed_position", "packed_rotation", "packed_scale", "packed_color"}))
        return PlyGaussians::kPacked;
    const bool plain = hasAll(vertex, {"x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1",
                                       "rot_0", "rot_1", "rot_2", "rot_3"});
    return plain ? PlyGaussians::kPlain : PlyGaussians::kNone;
}

void settleVertexRoles(const Source& source, PlyHeader& header) {
    const auto isVertex = [](const PlyElement& element) { return element.name == "vertex"; };
    const auto vertices = std::count_if(header.elements.begin(), header.elements.end(), isVertex);
    if (vertices != 1) refuse(source, vertices == 0 ? "no vertex element" : "more than one vertex element");
    PlyElement& vertex = *std::find_if(header.elements.begin(), header.elements.end(), isVertex);
    header.gaussians = gaussiansOf(vertex);
    if (header.gaussians == PlyGaussians::kPacked) return;
    std::vector<Role> roles = rolesOf(vertex);
    if (!hasPositions(roles)) refuse(source, "the vertices have no x, y and z");
    header.harmonic_colors = takeHarmonicColors(vertex, roles);
    for (std::size_t i = 0; i < roles.size(); ++i) vertex.properties[i].role = roles[i];
}

/// Ascii values take two bytes at least, a digit and what separates it from the next.
std::size_t smallestSize(const PlyElement& element, PlyEncoding encoding) {
    std::size_t size = 0;
    for (const PlyProperty& property : element.properties)
        size +=
            encoding == PlyEncoding::kAscii ? 2 : scalarSize(property.is_list ? property.count_type : property.type);
    return size;
}

void checkPromises(const Source& source, const PlyHeader& header) {
    const bool ascii = header.encoding == PlyEncoding::kAscii;
    // The last value of an ascii file needs no separator.
    std::uint64_t left = static_cast<std::uint64_t>(source.end() - header.body) + (ascii ? 1 : 0);
    for (const PlyElement& element : header.elements) {
        const std::size_t size = smallestSize(element, header.encoding);
        if (element.count > left / size)
            refuse(source, ascii ? fmt::format("the header promises {} {}, only {} bytes are left for them",
                                               element.count, pluralOf(element), left - 1)
                                 : fmt::format("cut short: {} of {} {} are there", left / size, element.count,
                                               pluralOf(element)));
        left -= element.count * size;
    }
}

} // namespace

PlyHeader readPlyHeader(const Source& source) {
    HeaderLines lines(source.bytes);
    std::string_view line;
    if (!lines.next(line) || nextWord(line) != "ply") refuse(source, "does not start with 'ply'");
    PlyHeader header;
    parseLines(source, lines, header);
    settleVertexRoles(source, header);
    // of elements with nothing to read there may be any number
    std::erase_if(header.elements, [](const PlyElement& element) { return element.properties.empty(); });
    checkPromises(source, header);
    return header;
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
