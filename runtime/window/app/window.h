// SPDX-License-Identifier: Apache-2.0
// The window of pointrt-view.
#pragma once

#include "runtime/session/options.h"

namespace pointrt {

/// Opens the window with options.inputs, or with the start page if there are none. Returns when the user closes it, or
/// when the recording options.replay ends. Throws Error: kCannotRun without a display or device, kBadInput for an
/// invalid recording or an initial scene that cannot be read.
void runWindow(const Options& options);

} // namespace pointrt
