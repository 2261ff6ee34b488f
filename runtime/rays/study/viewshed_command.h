// SPDX-License-Identifier: Apache-2.0
// pointrt-rays viewshed: which points observers see.
#pragma once

namespace pointrt {

/// @param argv from "viewshed" on
int viewshedCommand(int argc, const char* const* argv);

} // namespace pointrt
