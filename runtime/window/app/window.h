// SPDX-License-Identifier: Apache-2.0
// pointrt-view's window.
#pragma once

#include "runtime/session/options.h"

namespace pointrt {

/// Shows options.scene until the user, or the recording that options.replay names, closes the window. Throws Error:
/// kCannotRun without a display or device, kBadInput for a recording or, at the start, a scene that cannot be read.
void runWindow(const Options& options);

} // namespace pointrt
