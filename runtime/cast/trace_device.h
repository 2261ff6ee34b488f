// SPDX-License-Identifier: Apache-2.0
// The state of a TraceDevice.
#pragma once

#include <string>

#include "pointrt/trace.hpp"
#include "runtime/gpu/device.h"

namespace pointrt {

/// Scenes use workers of the device, so that threads share nothing but its queue.
struct TraceDevice::State {
    explicit State(const std::string& selector);
    ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    Device device;
};

} // namespace pointrt
