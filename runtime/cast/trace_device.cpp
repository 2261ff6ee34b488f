// SPDX-License-Identifier: Apache-2.0
#include "runtime/cast/trace_device.h"

#include "runtime/cast/translated.h"

namespace pointrt {
namespace {

DeviceRequest requestOf(const std::string& selector) {
    DeviceRequest request;
    request.selector = selector;
    return request;
}

} // namespace

TraceDevice::State::State(const std::string& selector) : device(createDevice(requestOf(selector))) {}

TraceDevice::State::~State() { destroyDevice(device); }

TraceDevice::TraceDevice(const std::string& selector)
    : state_(translated([&] { return std::make_shared<State>(selector); })) {}
TraceDevice::~TraceDevice() = default;
TraceDevice::TraceDevice(TraceDevice&&) noexcept = default;
TraceDevice& TraceDevice::operator=(TraceDevice&&) noexcept = default;

const std::string& TraceDevice::name() const { return state_->device.name; }

} // namespace pointrt
