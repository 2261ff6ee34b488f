// SPDX-License-Identifier: Apache-2.0
// The programs for batches of rays, built for what a scene's instances are like.
#pragma once

#include <map>

#include "runtime/device_scene/device_scene.h"
#include "runtime/gpu/program.h"
#include "runtime/tracer/instance_traits.h"

namespace pointrt {

/// Both declare the same bindings.
struct CastPair {
    Program first_hit, any_hit;
};
using CastPrograms = std::map<InstanceTraits, CastPair>;

/// Throws Error kCannotRun where the driver refuses one.
CastPrograms createCastPrograms(Device& device, const DeviceScene& scene);
void destroyCastPrograms(Device& device, CastPrograms& programs);

} // namespace pointrt
