// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of the stages of a bake.
#pragma once

#include <functional>

namespace pointrt {

/// Called with the name of a stage and the fraction of it done, 0 to 1, from the calling thread only.
using StageProgress = std::function<void(const char* stage, double share)>;

} // namespace pointrt
