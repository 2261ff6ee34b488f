// SPDX-License-Identifier: Apache-2.0
// Classifies pixels as right or wrong.
#pragma once

#include "tests/bench/quality/statistics.h"
#include "tests/bench/quality/views.h"

namespace pointrt::quality {

enum class PixelClass : std::uint8_t {
    kEmpty,   ///< neither mesh nor splat
    kMatch,   ///< both mesh and splat
    kExcess,  ///< splats beyond the mesh's silhouette
    kMissing, ///< no splat at the mesh's silhouette
    kHole,    ///< inside: no splat, or more than a median radius behind the mesh
    kBridge   ///< splats more than a median radius off the mesh
};

/// Counts over views. A pixel is inside if the mesh is hit and has no depth jump within kInsidePixels of it.
struct ViewErrors {
    std::size_t mesh_pixels = 0, splat_pixels = 0, inside_pixels = 0;
    std::size_t silhouette_pixels = 0; ///< mesh pixels next to one without mesh: the length of the silhouette
    std::size_t excess = 0, missing = 0, holes = 0, bridges = 0;
    std::vector<float> inside_depth;     ///< |splats - mesh| along the ray, inside except holes, in median radii
    std::vector<float> surface_distance; ///< from hits on splats to the mesh, in median radii
};

constexpr int kInsidePixels = 4;

/// Adds the view to errors and returns the class of each pixel.
std::vector<PixelClass> classifyView(const View& view, float median_radius, ViewErrors& errors);

/// Writes classes as a binary PPM: grey matches, blue excess, yellow missing, red holes, magenta bridges.
/// Throws Error (kCannotWrite).
void writeClasses(const std::string& path, const std::vector<PixelClass>& classes);

} // namespace pointrt::quality
