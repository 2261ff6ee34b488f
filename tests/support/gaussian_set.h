// SPDX-License-Identifier: Apache-2.0
// A tile set of Gaussians, baked from a PLY by all steps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "format/set/tile_set.h"
#include "tests/gaussians/oracle.h"

namespace pointrt::test {

/// Writes FOLDER/capture.ply and the set FOLDER/capture.proset, which it returns.
TileSet bakeGaussianSet(const std::string& folder, const std::vector<OracleGaussian>& gaussians,
                        std::uint64_t per_tile);

} // namespace pointrt::test
