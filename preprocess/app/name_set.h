// SPDX-License-Identifier: GPL-3.0-or-later
// Gives a finished set its name and deletes the work folder.
#pragma once

#include "preprocess/tiles/plan.h"

namespace pointrt {

/// Renames the set in finishedFolder(plan.work) to plan.output, atomically, in place of an existing one. Then deletes
/// the work folder; with keep_work only what would obstruct the next bake. Throws Error (kCannotWrite).
void nameSet(const SetPlan& plan, bool keep_work);

/// Completes the clean-up of a bake that was killed during it, after the set had got its name.
void clearNamed(const std::string& output, const std::string& work, bool keep_work);

} // namespace pointrt
