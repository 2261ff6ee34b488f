// SPDX-License-Identifier: Apache-2.0
// What is behind a TraceDevice.
#pragma once

#include <string>

#include "pointrt/trace.hpp"
#include "runtime/gpu/device.h"

namespace pointrt {

/// Scenes work through workers of it, so that threads never meet in it.
struct TraceDevice::State {
    explicit State(const std::string& selector);
    ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    Device device;
};

} // namespace pointrt
