// SPDX-License-Identifier: Apache-2.0
// Number formatting.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/util/vec.h"

namespace pointrt {

/// Decimals to resolve 1e-4 of size: 0 to 9.
int decimalsFor(double size);
/// The size with which to format measured positions: digits then resolve 1e-6 of the scene, twice the 2^-21 to which a
/// scan's positions are rounded.
constexpr double measuredSize(double scene_size) { return 1e-2 * scene_size; }
/// A length or coordinate in a scene of this size.
std::string lengthText(double value, double size);
/// Three coordinates.
std::string pointText(Vec3 point, double size);
/// "12 345 678"
std::string countText(std::uint64_t count);
/// "1.2 GB", in powers of 1000.
std::string bytesText(std::uint64_t bytes);

} // namespace pointrt
