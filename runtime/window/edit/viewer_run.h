// SPDX-License-Identifier: Apache-2.0
// Renders in the background with a pointrt-view process, so that pictures equal those of the command line.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/scene_description.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

/// Runs pointrt-view on the scene with these options, and reports its progress. Throws Error with the reason that
/// pointrt-view gives, or JobCancelled.
/// @param device selects the device; empty: by default
void runViewer(const SceneDescription& scene, const std::vector<std::string>& options, const std::string& device,
               JobControl& control);

} // namespace pointrt
