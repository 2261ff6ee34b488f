// SPDX-License-Identifier: Apache-2.0
// Rays in a NumPy array of float32 or float64, (N, 6) or as wide as its RowKind.
#pragma once

#include <memory>

#include "runtime/rays/byte_input.h"
#include "runtime/rays/ray_source.h"

namespace pointrt {

/// @param input at the first byte of the array
/// Throws Error kBadInput "NAME: reason" if the array does not hold rays.
std::unique_ptr<RaySource> npyRays(std::unique_ptr<ByteInput> input, const RowKind& kind);

} // namespace pointrt
