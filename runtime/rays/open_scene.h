// SPDX-License-Identifier: Apache-2.0
// Opens the scene of a command.
#pragma once

#include <string>

#include "pointrt/trace.hpp"
#include "runtime/rays/common_options.h"

namespace pointrt {

/// The scene keeps the device alive. Throws TraceError.
inline TraceScene openScene(const CommonOptions& options, std::string& device_name) {
    const TraceDevice device(options.device);
    device_name = device.name();
    return TraceScene(device, options.scene, options.scene_options);
}

} // namespace pointrt
