// SPDX-License-Identifier: Apache-2.0
// Directional albedo of single-scattering GGX, for the shaders' multiple-scattering compensation.
#pragma once

#include <array>
#include <vector>

namespace pointrt {

/// The parts of a directional albedo that do not depend on colour. With Schlick's Fresnel term of reflectance f at
/// normal incidence the lobe reflects f * (1 - lost - grazing) + grazing of the light.
struct GgxAlbedo {
    float lost = 0;    ///< share that perfectly reflecting facets do not reflect, by shadowing, in [0, 1]
    float grazing = 0; ///< share reflected with Schlick's weight (1 - cosine)^5, in [0, 1 - lost]
};

/// One entry, by quadrature over the visible normals (Heitz 2018, height-correlated Smith shadowing). The error is at
/// most 0.003, and largest for cosines below 0.01.
/// @param cosine in (0, 1]
/// @param roughness in (0, 1]; GGX's alpha is its square
GgxAlbedo ggxAlbedoAt(double cosine, double roughness);

/// GGX_TABLE_ENTRIES entries (shaders/shared/ggx_table.h). Entry row * GGX_TABLE_SIDE + column is for cosine x^2 and
/// roughness GGX_MIN_ROUGHNESS + (1 - GGX_MIN_ROUGHNESS) * y with x, y = column, row / (GGX_TABLE_SIDE - 1). The
/// last row holds, by roughness, the cosine-weighted mean over all directions of the row's piecewise linear function of
/// x: shaders interpolate the same function, so energy is conserved whatever the table's error.
std::vector<GgxAlbedo> ggxAlbedoTable();

} // namespace pointrt
