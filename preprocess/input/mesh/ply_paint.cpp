// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/ply_paint.h"

#include <algorithm>
#include <cmath>

#include "preprocess/input/mesh/picture.h"

namespace pointrt {
namespace {

/// The value of a fully bright colour in a type.
double fullOf(Scalar type) { return isReal(type) ? 1 : type == Scalar::kU16 ? 65535 : 255; }

const PlyProperty* scalarNamed(const PlyElement& element, std::initializer_list<std::string_view> names) {
    for (const PlyProperty& property : element.properties)
        if (!property.is_list && std::find(names.begin(), names.end(), property.name) != names.end()) return &property;
    return nullptr;
}

} // namespace

PlyPaint::PlyPaint(const InputFile& input, const PlyHeader& header, Sink& sink) {
    const PlyElement& vertex = vertexElement(header);
    uses_colors_ = std::none_of(vertex.properties.begin(), vertex.properties.end(),
                                [](const PlyProperty& property) { return property.dimension == kRed; });
    if (!hasFaces(header)) return;
    for (const std::string& name : header.textures) textures_.push_back(addTexture(input, name, sink));
    if (textures_.empty()) return;
    u_ = scalarNamed(vertex, {"s", "u", "texture_u", "texture_s"});
    v_ = scalarNamed(vertex, {"t", "v", "texture_v", "texture_t"});
}

void PlyPaint::beginFace() {
    color_ = {};
    texture_ = 0;
    coordinates_.clear();
}

bool PlyPaint::takes(const PlyProperty& property) const {
    if (property.is_list) return property.name == "texcoord" && !textures_.empty();
    if (property.name == "texnumber") return !textures_.empty();
    const Dimension dimension = dimensionOfName(property.name);
    return uses_colors_ && dimension >= kRed && dimension <= kBlue;
}

void PlyPaint::take(const PlyProperty& property, double value) {
    if (property.is_list)
        coordinates_.push_back(value);
    else if (property.name == "texnumber")
        texture_ = value;
    else
        color_[dimensionOfName(property.name) - kRed] = std::clamp(value / fullOf(property.type), 0.0, 1.0) * 255;
}

/// The places of the face's corners: its own, else those of its vertices.
bool PlyPaint::placesOf(const std::vector<std::uint32_t>& corners) {
    places_.clear();
    if (!corners.empty() && coordinates_.size() == 2 * corners.size())
        for (std::size_t i = 0; i < corners.size(); ++i)
            places_.emplace_back(static_cast<float>(coordinates_[2 * i]), static_cast<float>(coordinates_[2 * i + 1]));
    else if (!vertex_places_.empty())
        for (const std::uint32_t corner : corners)
            places_.push_back(corner < vertex_places_.size() ? vertex_places_[corner] : Eigen::Vector2f(0, 0));
    return !places_.empty();
}

PolygonPaint PlyPaint::paintOf(const std::vector<std::uint32_t>& corners) {
    PolygonPaint paint;
    const bool known = texture_ >= 0 && texture_ < static_cast<double>(textures_.size());
    if (known && textures_[static_cast<std::size_t>(texture_)] && placesOf(corners)) {
        paint.picture = *textures_[static_cast<std::size_t>(texture_)];
        paint.places = places_;
    } else if (color_[0] && color_[1] && color_[2]) {
        paint.picture = FacePaint::kPlain;
        for (std::size_t i = 0; i < 3; ++i) paint.color[i] = static_cast<std::uint8_t>(*color_[i] + 0.5);
    }
    return paint;
}

} // namespace pointrt
