// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/ply_attributes.h"

#include <algorithm>
#include <array>

#include "preprocess/input/attribute_names.h"

namespace pointrt {
namespace {

bool isColor(Role role) { return role >= kRed && role <= kBlue; }

/// As Blender, MeshLab and others write them.
bool isTextureCoordinate(const std::string& name) {
    for (const char* each : {"s", "t", "u", "v", "texture_u", "texture_v", "tex_u", "tex_v"})
        if (name == each) return true;
    return false;
}

/// Appends a column behind the values that are packed already; returns where.
std::size_t addColumn(PlyHeader& header, const std::string& name, Scalar type, std::uint32_t components) {
    const std::size_t place = header.packed_size;
    header.columns.push_back({name, type, components});
    header.packed_size += components * scalarSize(type);
    return place;
}

/// Three colours of 16 bits are an attribute too, which keeps all of them.
void packWideColors(PlyHeader& header, PlyElement& vertex, AttributeNames& names) {
    const auto isWide = [](const PlyProperty& property) {
        return isColor(property.role) && property.type == Scalar::kU16;
    };
    if (std::count_if(vertex.properties.begin(), vertex.properties.end(), isWide) != 3) return;
    const std::size_t place = addColumn(header, *names.take(kRgb16), Scalar::kU16, 3);
    for (PlyProperty& property : vertex.properties)
        if (isWide(property)) property.place = place + 2 * static_cast<std::size_t>(property.role - kRed);
}

/// What pointrt-info --export writes of them beside 8-bit ones: rgb16_0, rgb16_1 and rgb16_2.
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

/// Discs are told by normals beside their radii; of a mesh's vertices it is something else.
void takeRadii(const PlyHeader& header, PlyElement& vertex) {
    std::vector<Role> roles;
    for (const PlyProperty& property : vertex.properties) roles.push_back(property.role);
    if (!hasNormals(roles) || hasFaces(header)) return;
    for (PlyProperty& property : vertex.properties) {
        if (property.name != "radius" || property.is_list || !isReal(property.type)) continue;
        property.role = kRadius;
        return;
    }
}

/// Whether a property is none of the points', and nothing to tell of either.
bool isOfTexture(const PlyHeader& header, const PlyProperty& property) {
    return isTextureCoordinate(property.name) && hasFaces(header);
}

bool isHarmonic(const PlyHeader& header, const PlyProperty& property) {
    return header.harmonic_colors && property.name.starts_with("f_rest_");
}

} // namespace

std::string settlePlyAttributes(PlyHeader& header) {
    PlyElement& vertex = *std::find_if(header.elements.begin(), header.elements.end(),
                                       [](const PlyElement& element) { return element.name == "vertex"; });
    AttributeNames names;
    std::string unread;
    packWideColors(header, vertex, names);
    joinWideColors(header, vertex, names);
    takeRadii(header, vertex);
    for (PlyProperty& property : vertex.properties) {
        if (property.role != kIgnored || property.place || isOfTexture(header, property)) continue;
        const bool is_number = !property.is_list && !isHarmonic(header, property);
        if (const auto name = is_number ? names.take(property.name) : std::nullopt)
            property.place = addColumn(header, *name, property.type, 1);
        else if (unread.size() < 80) // a line's worth
            unread += (unread.empty() ? "" : ", ") + inQuotes(property.name);
    }
    return unread;
}

} // namespace pointrt
