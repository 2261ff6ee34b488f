// SPDX-License-Identifier: Apache-2.0
// Splat clouds of known geometry, and baking them to a .pro.
#pragma once

#include <string>

#include "preprocess/cloud/splats.h"
#include "preprocess/octree/octree.h"
#include "preprocess/octree/write.h"

namespace pointrt::test {

/// count splats on a sphere by the Fibonacci lattice, normals outwards; radius_factor times the mean spacing.
Splats sphereSplats(std::size_t count, const Vec3f& center, float sphere_radius, float radius_factor = 1.2f);

/// side * side splats on a square around center, spanned by the half edges u and v; the normal is u x v.
Splats squareSplats(std::size_t side, const Vec3f& center, const Vec3f& u, const Vec3f& v, float radius_factor = 1.0f);

/// Random positions, normals and radii: no surface, but every case of the octree.
Splats randomSplats(std::size_t count, unsigned seed, float radius_min, float radius_max);

/// The splats of a, then those of b; both must have colours, or neither.
Splats joinSplats(Splats a, const Splats& b);
void paint(Splats& splats, Rgb8 color);
/// Turns all splats into balls, of their radii.
void makeBalls(Splats& splats);

struct BuildOptions {
    OctreeOptions octree;
    bool prune = false;
    PruneOptions probes;
    std::vector<MaterialRow> materials; ///< empty: one matte white row
};

struct Built {
    PackedSplats packed;
    Octree octree;
    PruneReport pruning; ///< zeros without pruning
};

Built buildSplats(Splats splats, const BuildOptions& options);
MaterialRow matteRow(float r, float g, float b, float reflectivity = 0);

/// Bakes and writes path. material: row of each splat in input order, or empty.
Built writeScene(const std::string& path, Splats splats, const BuildOptions& options,
                 const std::vector<std::uint8_t>& material = {});

/// A path in the temporary folder of this test process, which is removed at exit.
std::string temporaryPath(const std::string& name);

} // namespace pointrt::test
