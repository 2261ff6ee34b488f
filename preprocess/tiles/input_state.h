// SPDX-License-Identifier: GPL-3.0-or-later
// What tells that a file is the one that was read before: its size and when it was last written.
#pragma once

#include <string>
#include <vector>

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Throws Error (kBadInput, "FILE: reason") for what is no regular file: a set's inputs are read twice.
std::vector<PlanInput> statesOf(const std::vector<std::string>& paths);

/// Throws Error (kBadInput, one line) where inputs are others than those of the plan.
void requireSameInputs(const SetPlan& plan, const std::vector<std::string>& paths);

/// The same where these have been written since.
void requireUnwritten(const SetPlan& plan, const std::vector<std::string>& paths);

} // namespace pointrt
