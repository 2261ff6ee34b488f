// SPDX-License-Identifier: Apache-2.0
// From rays to hits: read, cast, written, block by block.
#pragma once

#include "runtime/rays/cast_options.h"

namespace pointrt {

/// Memory does not grow with the number of rays. Throws Error with one line; then no output is there that was not.
void runCast(const CastOptions& options);

} // namespace pointrt
