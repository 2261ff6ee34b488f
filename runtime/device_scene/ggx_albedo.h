// SPDX-License-Identifier: Apache-2.0
// How much light GGX's single-scattering microfacets give back, for the shaders that put back the rest.
#pragma once

#include <array>
#include <vector>

namespace pointrt {

/// The parts of a directional albedo that do not depend on colour. With Schlick's Fresnel term of reflectance f at
/// normal incidence the lobe gives back f * (1 - lost - grazing) + grazing of the light.
struct GgxAlbedo {
    float lost = 0;    ///< share that perfectly reflecting facets do not give back: shadowed, in [0, 1]
    float grazing = 0; ///< share given back with Schlick's weight (1 - cosine)^5, in [0, 1 - lost]
};

/// One entry, by quadrature in the visible normals (Heitz 2018, height-correlated Smith shadowing); cosine in (0, 1],
/// roughness in (0, 1], GGX's alpha being its square. Off by at most 0.003, where cosine is under 0.01.
GgxAlbedo ggxAlbedoAt(double cosine, double roughness);

/// GGX_TABLE_ENTRIES entries (shaders/shared/ggx_table.h). Entry row * GGX_TABLE_SIDE + column is for cosine x^2 and
/// roughness GGX_MIN_ROUGHNESS + (1 - GGX_MIN_ROUGHNESS) * y with x, y = column, row / (GGX_TABLE_SIDE - 1). The
/// last row holds, by roughness, the mean over all directions, weighted by cosine, of the row's piecewise linear
/// function of x: what is read and its mean agree exactly, so that energy is conserved whatever the table's error.
std::vector<GgxAlbedo> ggxAlbedoTable();

} // namespace pointrt
