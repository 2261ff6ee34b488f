// SPDX-License-Identifier: Apache-2.0
// pointrt-rays cast: reads rays, casts them and writes their hits, block by block.
#pragma once

namespace pointrt {

/// Memory does not grow with the number of rays. Throws Error with a one-line message, and then leaves no new output
/// file.
/// @param argv from "cast" on
int castCommand(int argc, const char* const* argv);

} // namespace pointrt
