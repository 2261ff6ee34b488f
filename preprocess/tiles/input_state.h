// SPDX-License-Identifier: GPL-3.0-or-later
// Detects changes of input files by size and modification time.
#pragma once

#include <string>
#include <vector>

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Sizes and modification times. Throws Error (kBadInput, "FILE: reason") for a file that is not regular: the inputs of
/// a set are read twice.
std::vector<PlanInput> statesOf(const std::vector<std::string>& paths);

/// Throws Error (kBadInput, one line) if the inputs are not those of the plan.
void requireSameInputs(const SetPlan& plan, const std::vector<std::string>& paths);

/// Throws Error if an input was modified since the plan was made.
void requireUnwritten(const SetPlan& plan, const std::vector<std::string>& paths);

} // namespace pointrt
