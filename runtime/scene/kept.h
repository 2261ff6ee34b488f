// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// The half-spaces that clips keep of an instance; empty if no clip cuts it. Hidden instances are cut entirely.
std::vector<HalfSpace> keptOf(std::span<const ClipDescription> clips, const InstanceDescription& instance);

} // namespace pointrt
