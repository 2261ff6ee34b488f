// SPDX-License-Identifier: GPL-3.0-or-later
// How far a stage of the bake is.
#pragma once

#include <functional>

namespace pointrt {

/// Called with a stage's name and the share of it done in [0, 1], from the calling thread only.
using StageProgress = std::function<void(const char* stage, double share)>;

} // namespace pointrt
