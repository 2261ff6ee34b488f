// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "pointrt/pro.hpp"

namespace pointrt {

/// Splat numbers in the order of their input points; in file order where the file does not know it. Splats that fill
/// gaps between points are left out.
std::vector<std::uint32_t> inputOrder(const ProFile& file);

/// How many these are.
std::uint64_t inputCount(const ProFile& file);

} // namespace pointrt
