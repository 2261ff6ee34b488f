// SPDX-License-Identifier: Apache-2.0
// A device with the Vulkan validation layer; any of its messages fails the test.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>

#include "runtime/gpu/device.h"

namespace pointrt {

class ValidatedDevice {
public:
    explicit ValidatedDevice(const DeviceRequest& request = {}) : device(create(request)) {}
    ~ValidatedDevice() {
        destroyDevice(device);
        EXPECT_EQ(validationMessages(), messages_before_);
    }
    ValidatedDevice(const ValidatedDevice&) = delete;
    ValidatedDevice& operator=(const ValidatedDevice&) = delete;

private:
    Device create(const DeviceRequest& request) {
        setenv("POINTRT_VALIDATION", "1", 1);
        messages_before_ = validationMessages();
        return createDevice(request);
    }

    std::uint64_t messages_before_ = 0;

public:
    Device device;
};

/// Fixture of tests that need a device each.
class DeviceFixture : public testing::Test {
protected:
    explicit DeviceFixture(const DeviceRequest& request = {}) : validated_(request) {}

    ValidatedDevice validated_;
    Device& device = validated_.device;
};

} // namespace pointrt
