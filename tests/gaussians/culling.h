// SPDX-License-Identifier: Apache-2.0
// Which Gaussians a rectangle of a picture may show. Conservative: the peak of a Gaussian that counts lies in its
// ellipsoid and in the rectangle's pyramid, so a Gaussian whose ellipsoid misses the pyramid cannot count.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/gaussians/oracle_camera.h"

namespace pointrt::test {

/// The ellipsoid in which a Gaussian counts, as an eye sees it.
struct SeenEllipsoid {
    Double3 direction{};                ///< of its centre, unit length
    double sine = 0, cosine = 1;        ///< of the angle from the centre to the edge of the sphere around it
    bool encloses_eye = false;          ///< whether the sphere does
    Double3 center{};                   ///< from the eye
    std::array<Double3, 3> half_axes{}; ///< orthogonal
};

/// One for each Gaussian; all half axes are 0 for those that count nowhere.
std::vector<SeenEllipsoid> ellipsoidsFrom(const Double3& eye, const OracleScene& scene);

/// Pixel edges: from left up to right, from top down to bottom.
struct PixelRectangle {
    std::uint32_t left = 0, top = 0, right = 0, bottom = 0;
};

/// The candidates whose ellipsoids may intersect a ray through the rectangle, in their order.
std::vector<std::uint32_t> seenThrough(const OracleCamera& camera, PixelRectangle rectangle,
                                       std::span<const SeenEllipsoid> ellipsoids,
                                       std::span<const std::uint32_t> candidates);

} // namespace pointrt::test
