// SPDX-License-Identifier: Apache-2.0
// Pixels into right and wrong.
#pragma once

#include "tests/bench/quality/statistics.h"
#include "tests/bench/quality/views.h"

namespace pointrt::quality {

enum class PixelClass : std::uint8_t {
    kEmpty,   ///< neither the mesh nor a splat
    kMatch,   ///< both
    kExcess,  ///< splats beyond the mesh's silhouette
    kMissing, ///< no splat at the mesh's silhouette
    kHole,    ///< inside: no splat, or one more than a median radius behind the mesh
    kBridge   ///< splats more than a median radius off the mesh
};

/// Counts over views. A pixel is inside when, up to kInsidePixels around it, the mesh is hit and goes on without a
/// jump.
struct ViewErrors {
    std::size_t mesh_pixels = 0, splat_pixels = 0, inside_pixels = 0;
    std::size_t silhouette_pixels = 0; ///< mesh pixels next to one without: the length of the silhouette
    std::size_t excess = 0, missing = 0, holes = 0, bridges = 0;
    std::vector<float> inside_depth;     ///< |splats - mesh| along the ray, inside and not a hole, in median radii
    std::vector<float> surface_distance; ///< of places hit on splats to the mesh, in median radii
};

constexpr int kInsidePixels = 4;

/// Adds the view to errors and returns the class of each pixel.
std::vector<PixelClass> classifyView(const View& view, float median_radius, ViewErrors& errors);

/// Writes classes as a binary PPM: grey matches, blue excess, yellow missing, red holes, magenta bridges.
/// Throws Error (kCannotWrite).
void writeClasses(const std::string& path, const std::vector<PixelClass>& classes);

} // namespace pointrt::quality
