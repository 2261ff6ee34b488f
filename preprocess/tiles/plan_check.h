// SPDX-License-Identifier: GPL-3.0-or-later
// Whether a plan that was read can be one: what steps index with it, they do not ask again.
#pragma once

#include <string>

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Why it cannot; "" for a good one.
std::string findPlanFault(const SetPlan& plan);

} // namespace pointrt
