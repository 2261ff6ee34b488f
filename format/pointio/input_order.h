// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "pointrt/pro.hpp"

namespace pointrt {

/// Indices of splats in the order of their input points, or in file order if the file does not record it. Excludes
/// splats that fill gaps.
std::vector<std::uint32_t> inputOrder(const ProFile& file);

/// The number of splats that inputOrder returns.
std::uint64_t inputCount(const ProFile& file);

} // namespace pointrt
