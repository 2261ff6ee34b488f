// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "runtime/scene/scene_description.h"

namespace pointrt {

/// What clips keep of an instance; empty if they do not cut it. Nothing of a hidden one.
std::vector<HalfSpace> keptOf(std::span<const ClipDescription> clips, const InstanceDescription& instance);

} // namespace pointrt
