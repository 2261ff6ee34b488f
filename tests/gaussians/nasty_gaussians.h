// SPDX-License-Identifier: Apache-2.0
// Synthetic scenes of Gaussians that are hard to trace. All except giants lie around the cube from -1 to 1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/gaussians/oracle.h"

namespace pointrt::test {

/// random: blobs of all sizes and opacities. giants: among them faint ones of up to a thousand times the scene.
/// needles: a thousand times as long as wide. layers: faint sheets along the z axis, of which thousands count. inside:
/// around the origin, for a camera there. opacities: 1, just above and just below what counts. duplicates: groups of 4
/// that differ in colour only. borders: means on the borders of octree cells. mixed: all of these in turn.
std::vector<std::string> gaussianKinds();

/// With harmonics of degree 3. Equal arguments give equal Gaussians. Throws std::invalid_argument for another kind.
std::vector<OracleGaussian> makeGaussians(const std::string& kind, std::size_t count, std::uint64_t seed = 1);

} // namespace pointrt::test
