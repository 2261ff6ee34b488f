// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of the faces of PLY files, and places in the textures that a comment names.
#pragma once

#include <optional>
#include <vector>

#include "preprocess/ingest/sink.h"
#include "preprocess/input/mesh/ply_header.h"

namespace pointrt {

/// Collects the values of one face after another, and the texture places of vertices.
class PlyPaint {
public:
    /// Reads the textures, with a note for each that is missing.
    PlyPaint(const InputFile& input, const PlyHeader& header, Sink& sink);

    /// The value of a vertex's property, if it is a texture coordinate.
    void takeOfVertex(const PlyProperty& property, double value) {
        if (&property == u_) place_.x() = static_cast<float>(value);
        if (&property == v_) place_.y() = static_cast<float>(value);
    }
    /// Stores the place of the vertex whose values were taken.
    void addVertex() {
        if (u_ && v_) vertex_places_.push_back(place_);
    }

    void beginFace();
    /// Whether a face's property is wanted: red, green, blue, texnumber, or the list texcoord.
    bool takes(const PlyProperty& property) const;
    /// Takes the value of such a property; for a list, called for each of its values.
    void take(const PlyProperty& property, double value);
    /// The colour of the face with these corners, valid until the next face.
    PolygonPaint paintOf(const std::vector<std::uint32_t>& corners);

private:
    bool placesOf(const std::vector<std::uint32_t>& corners);

    std::vector<std::optional<std::uint32_t>> textures_; ///< index into the sink's pictures
    bool uses_colors_ = false;                           ///< colours of faces are used, since vertices have none
    const PlyProperty *u_ = nullptr, *v_ = nullptr;      ///< of vertices
    Eigen::Vector2f place_ = Eigen::Vector2f::Zero();    ///< of the current vertex
    std::vector<Eigen::Vector2f> vertex_places_;

    std::array<std::optional<double>, 3> color_; ///< of the face, 0 to 255
    double texture_ = 0;
    std::vector<double> coordinates_;
    std::vector<Eigen::Vector2f> places_;
};

} // namespace pointrt
