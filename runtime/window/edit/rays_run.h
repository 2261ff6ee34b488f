// SPDX-License-Identifier: Apache-2.0
// Studies by pointrt-rays in the background.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/scene_description.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

/// The scan in its place, without properties that only pictures show: a scene file of it needs no materials.
InstanceDescription bareScan(InstanceDescription scan);

/// Runs a command of pointrt-rays and reports its progress if it is verbose. Throws Error with its reason, or
/// JobCancelled.
/// @param tool the path of pointrt-rays
/// @param device selects the device; empty: by default
void runRays(const std::string& tool, const std::string& command, const std::vector<std::string>& arguments,
             const std::string& device, JobControl& control);

} // namespace pointrt
