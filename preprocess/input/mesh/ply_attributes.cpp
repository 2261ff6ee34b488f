// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/ply_attributes.h"

#include <algorithm>
#include <array>

#include "preprocess/ingest/attribute_names.h"

namespace pointrt {
namespace {

bool isColor(Dimension dimension) { return dimension >= kRed && dimension <= kBlue; }

/// Names written by Blender, MeshLab and others.
bool isTextureCoordinate(const std::string& name) {
    for (const char* each : {"s", "t", "u", "v", "texture_u", "texture_v", "tex_u", "tex_v"})
        if (name == each) return true;
    return false;
}

/// Appends a column to the packed values and returns its offset.
std::size_t addColumn(PlyHeader& header, const std::string& name, Scalar type, std::uint32_t components) {
    const std::size_t place = header.packed_size;
    header.columns.push_back({name, type, components});
    header.packed_size += components * scalarSize(type);
    return place;
}

/// Three 16-bit colours also become an attribute, which keeps all of their bits.
void packWideColors(PlyHeader& header, PlyElement& vertex, AttributeNames& names) {
    const auto isWide = [](const PlyProperty& property) {
        return isColor(property.dimension) && property.type == Scalar::kU16;
    };
    if (std::count_if(vertex.properties.begin(), vertex.properties.end(), isWide) != 3) return;
    const std::size_t place = addColumn(header, *names.take(kRgb16), Scalar::kU16, 3);
    for (PlyProperty& property : vertex.properties)
        if (isWide(property)) property.place = place + 2 * static_cast<std::size_t>(property.dimension - kRed);
}

/// 16-bit colours that pointrt-info --export writes beside 8-bit ones: rgb16_0, rgb16_1 and rgb16_2.
void joinWideColors(PlyHeader& header, PlyElement& vertex, AttributeNames& names) {
    std::array<PlyProperty*, 3> parts{};
    for (PlyProperty& property : vertex.properties)
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (property.name == fmt::format("{}_{}", kRgb16, i) && property.type == Scalar::kU16 && !property.is_list)
                parts[i] = &property;
    if (!parts[0] || !parts[1] || !parts[2]) return;
    const auto name = names.take(kRgb16);
    if (!name) return;
    const std::size_t place = addColumn(header, *name, Scalar::kU16, 3);
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i]->place = place + 2 * i;
}

/// A radius means that of a disc if there are normals and no faces.
void takeRadii(const PlyHeader& header, PlyElement& vertex) {
    std::vector<Dimension> dimensions;
    for (const PlyProperty& property : vertex.properties) dimensions.push_back(property.dimension);
    if (!hasNormals(dimensions) || hasFaces(header)) return;
    for (PlyProperty& property : vertex.properties) {
        if (property.name != "radius" || property.is_list || !isReal(property.type)) continue;
        property.dimension = kRadius;
        return;
    }
}

/// Whether to skip a property without a note: it does not belong to the points.
bool isOfTexture(const PlyHeader& header, const PlyProperty& property) {
    return isTextureCoordinate(property.name) && hasFaces(header);
}

bool isHarmonic(const PlyHeader& header, const PlyProperty& property) {
    return header.harmonic_colors && property.name.starts_with("f_rest_");
}

} // namespace

std::string assignPlyAttributes(PlyHeader& header) {
    PlyElement& vertex = *std::find_if(header.elements.begin(), header.elements.end(),
                                       [](const PlyElement& element) { return element.name == "vertex"; });
    AttributeNames names;
    std::string unread;
    packWideColors(header, vertex, names);
    joinWideColors(header, vertex, names);
    takeRadii(header, vertex);
    for (PlyProperty& property : vertex.properties) {
        if (property.dimension != kIgnored || property.place || isOfTexture(header, property)) continue;
        const bool is_number = !property.is_list && !isHarmonic(header, property);
        if (const auto name = is_number ? names.take(property.name) : std::nullopt)
            property.place = addColumn(header, *name, property.type, 1);
        else
            addQuoted(property.name, unread);
    }
    return unread;
}

} // namespace pointrt
