// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of a mesh's faces: plain, or of a texture.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "preprocess/cloud/cloud.h"

namespace pointrt {

/// A picture of 8-bit sRGB pixels, top row first.
struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgb;

    /// The bilinear mixture of the four nearest pixels. (0, 0) is the lower left corner, (1, 1) the upper right one;
    /// the picture repeats beyond.
    Rgb8 at(const Eigen::Vector2d& place) const;
};

/// The colour of one triangle.
struct FacePaint {
    static constexpr std::uint32_t kNone = ~std::uint32_t{0}, kPlain = kNone - 1;

    std::uint32_t picture = kNone; ///< index into MeshPaint::pictures; kNone: no colour; kPlain: `color`
    Rgb8 color{};
    std::array<Eigen::Vector2f, 3> places{}; ///< of its corners in the picture
};

/// The colour of a polygon; for a picture, the places of its corners in it.
struct PolygonPaint {
    std::uint32_t picture = FacePaint::kNone;
    Rgb8 color{};
    std::span<const Eigen::Vector2f> places = {};

    FacePaint ofTriangle(std::size_t a, std::size_t b, std::size_t c) const {
        FacePaint paint{picture, color, {}};
        if (!places.empty()) paint.places = {places[a], places[b], places[c]};
        return paint;
    }
};

struct MeshPaint {
    std::vector<FacePaint> faces; ///< for the cloud's first triangles; further ones have no colour
    std::vector<Picture> pictures;
    std::map<std::string, std::uint32_t> picture_of_file; ///< by its path, or another key
    std::uint64_t picture_file_bytes = 0;                 ///< total size of these files

    bool has(std::size_t face) const { return face < faces.size() && faces[face].picture != FacePaint::kNone; }
    /// The colour of a face with one. weights: barycentric
    Rgb8 at(std::size_t face, const Vec3d& weights) const;
};

} // namespace pointrt
