// SPDX-License-Identifier: Apache-2.0
// Rays in a NumPy array, (N, 6), or as wide as its kind of rows is, of float32 or float64.
#pragma once

#include <memory>

#include "runtime/rays/byte_input.h"
#include "runtime/rays/ray_source.h"

namespace pointrt {

/// input is at the array's first byte. Throws Error kBadInput "NAME: reason" where it does not hold rays.
std::unique_ptr<RaySource> npyRays(std::unique_ptr<ByteInput> input, const RowKind& kind);

} // namespace pointrt
