// SPDX-License-Identifier: Apache-2.0
// First hits of each pixel: of a mesh by Embree, of splats as rendered by pointrt-view.
#pragma once

#include <cmath>
#include <limits>
#include <string>

#include "tests/bench/quality/raw/camera.h"
#include "tests/bench/quality/tracing.h"

namespace pointrt::quality {

/// The first hit of one pixel.
struct Sight {
    float t = std::numeric_limits<float>::infinity(); ///< along the pixel's ray, unit frame; infinite for a miss
    Vec3f normal = Vec3f::Zero();                     ///< unit length, towards the eye

    bool hit() const { return std::isfinite(t); }
};

/// [size][size], rows go down.
using Sights = std::vector<Sight>;

/// A pinhole camera in the truth's unit frame.
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

/// First hits with interpolated vertex normals, as a renderer would shade the mesh.
Sights castMesh(const Mesh& mesh, const Tracing& tracing, const UnitCamera& camera);

/// First hits of a film that pointrt-view wrote with one sample per pixel: channels Z and N. Throws Error (kBadInput)
/// "PATH: reason" if the picture has another size or lacks these channels.
Sights readSights(const std::string& path, const Pinhole& camera, const UnitFrame& frame);

} // namespace pointrt::quality
