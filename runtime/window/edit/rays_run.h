// SPDX-License-Identifier: Apache-2.0
// Studies by pointrt-rays in the background.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/scene_description.h"
#include "runtime/window/edit/job.h"

namespace pointrt {

/// The scan with its placement but without the properties of its look, so that a scene file of it needs no materials.
InstanceDescription bareScan(InstanceDescription scan);

/// Runs a command of pointrt-rays and reports its progress if arguments make it verbose. Throws Error with the reason
/// that pointrt-rays gives, or JobCancelled.
/// @param tool the path of pointrt-rays
/// @param device selects the device; empty: by default
void runRays(const std::string& tool, const std::string& command, const std::vector<std::string>& arguments,
             const std::string& device, JobControl& control);

} // namespace pointrt
