// SPDX-License-Identifier: Apache-2.0
// pointrt-rays cast: from rays to hits, which are read, cast and written block by block.
#pragma once

namespace pointrt {

/// Memory does not grow with the number of rays. Throws Error with one line; then no output is there that was not.
/// @param argv from "cast" on
int castCommand(int argc, const char* const* argv);

} // namespace pointrt
