// SPDX-License-Identifier: Apache-2.0
// pointrt-rays sun: hours of direct sun on points, and how much of the sky they see.
#pragma once

namespace pointrt {

/// @param argv from "sun" on
int sunCommand(int argc, const char* const* argv);

} // namespace pointrt
