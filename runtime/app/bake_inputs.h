// SPDX-License-Identifier: Apache-2.0
// Bakes the scans of the command line before a picture is rendered.
#pragma once

#include "runtime/session/options.h"

namespace pointrt {

/// If options.inputs are scans, bakes them into the user's cache, with progress on standard error, and sets
/// options.scene and options.source. False if interrupted. Throws Error as bakeCached does.
bool bakeInputs(Options& options);

} // namespace pointrt
