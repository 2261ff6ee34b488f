// SPDX-License-Identifier: Apache-2.0
// The Gaussians of a .pro, by the C interface of the format.
#pragma once

#include <string>
#include <vector>

#include "tests/gaussians/oracle.h"

namespace pointrt::test {

/// In input coordinates; indices are those of the splats. Throws std::runtime_error "PATH: reason".
std::vector<OracleGaussian> readGaussianPro(const std::string& path);

} // namespace pointrt::test
