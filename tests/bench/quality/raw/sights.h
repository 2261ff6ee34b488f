// SPDX-License-Identifier: Apache-2.0
// What is seen through each pixel: of a mesh by Embree, of splats as pointrt-view rendered them.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "tests/bench/quality/raw/camera.h"
#include "tests/bench/quality/tracing.h"

namespace pointrt::quality {

/// Through one pixel.
struct Sight {
    float t = std::numeric_limits<float>::infinity(); ///< along the pixel's ray, unit frame; infinite: nothing
    Vec3f normal = Vec3f::Zero();                     ///< unit length, towards the eye

    bool hit() const { return std::isfinite(t); }
};

/// [size][size], rows downwards.
using Sights = std::vector<Sight>;

/// A pinhole in the truth's unit frame.
class UnitCamera {
public:
    UnitCamera(const Pinhole& camera, const UnitFrame& frame);
    Vec3f direction(std::size_t pixel) const;
    Vec3f place(std::size_t pixel, float t) const { return eye_ + t * direction(pixel); }
    const Vec3f& eye() const { return eye_; }
    int size() const { return size_; }
    std::size_t pixels() const { return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_); }

private:
    PinholeRays rays_;
    Vec3f eye_;
    int size_;
};

/// First hits; normals are those of vertices, interpolated, as a renderer would show the mesh.
Sights castMesh(const Mesh& mesh, const Tracing& tracing, const UnitCamera& camera);

/// First hits of a film that pointrt-view wrote with one sample a pixel: channels Z and N.
/// Throws Error (kBadInput) "PATH: reason" where the picture is of another size or has no such channels.
Sights readSights(const std::string& path, const Pinhole& camera, const UnitFrame& frame);

} // namespace pointrt::quality
