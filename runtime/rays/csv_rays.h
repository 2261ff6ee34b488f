// SPDX-License-Identifier: Apache-2.0
// Rays as text: a line for each with six numbers, or as many as its RowKind has, separated by commas, semicolons or
// blanks. Empty lines, comments starting with # and a first line with column names are skipped.
#pragma once

#include <memory>

#include "runtime/rays/byte_input.h"
#include "runtime/rays/ray_source.h"

namespace pointrt {

std::unique_ptr<RaySource> csvRays(std::unique_ptr<ByteInput> input, const RowKind& kind);

} // namespace pointrt
