// SPDX-License-Identifier: GPL-3.0-or-later
// Validates a plan that was read: later steps use its indices without checks.
#pragma once

#include <string>

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Why the plan is invalid; "" if it is valid.
std::string findPlanFault(const SetPlan& plan);

} // namespace pointrt
