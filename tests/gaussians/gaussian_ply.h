// SPDX-License-Identifier: Apache-2.0
// PLY files of Gaussians as training programs write them (Kerbl et al. 2023): binary, all properties floats, logarithms
// of deviations, logits of opacities. Shares no code with the readers of pointrt-bake.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/gaussians/oracle.h"

namespace pointrt::test {

/// Throws std::runtime_error "PATH: reason".
std::vector<OracleGaussian> readGaussianPly(const std::string& path);

/// The coefficients of the Gaussian with the most harmonics are written for all; others have zeros. An opacity of 1
/// becomes a logit that decodes to 1. Throws std::runtime_error "PATH: reason".
void writeGaussianPly(const std::string& path, const std::vector<OracleGaussian>& gaussians);

} // namespace pointrt::test
