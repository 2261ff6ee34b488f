// SPDX-License-Identifier: Apache-2.0
// The window of pointrt-view.
#pragma once

#include "runtime/session/options.h"

namespace pointrt {

/// Shows options.inputs, or a page to start from if there are none, until the user closes the window, or the recording
/// options.replay does. Throws Error: kCannotRun without a display or device, kBadInput for an invalid recording or an
/// initial scene that cannot be read.
void runWindow(const Options& options);

} // namespace pointrt
