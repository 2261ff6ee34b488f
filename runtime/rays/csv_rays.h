// SPDX-License-Identifier: Apache-2.0
// Rays as text, one a line: six numbers, or as many as its kind of rows has, apart by commas, semicolons or blanks.
// Empty lines, those that begin with #, and a first one that names columns are passed over.
#pragma once

#include <memory>

#include "runtime/rays/byte_input.h"
#include "runtime/rays/ray_source.h"

namespace pointrt {

std::unique_ptr<RaySource> csvRays(std::unique_ptr<ByteInput> input, const RowKind& kind);

} // namespace pointrt
