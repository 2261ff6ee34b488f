// SPDX-License-Identifier: GPL-3.0-or-later
// A set gets its name, and what it was made from goes.
#pragma once

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// The set in finishedFolder(plan) appears as plan.output in one moment, in place of one that is there. Then the work
/// folder goes; with keep_work only what is in the way of the next bake. Throws Error (kCannotWrite).
void nameSet(const SetPlan& plan, bool keep_work);

/// Goes on with that where a bake was ended while it took things away: the set has its name then.
void clearNamed(const std::string& output, const std::string& work, bool keep_work);

} // namespace pointrt
