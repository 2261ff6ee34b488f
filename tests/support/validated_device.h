// SPDX-License-Identifier: Apache-2.0
// A device under the validation layer, any message of which fails the test.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>

#include "runtime/gpu/device.h"

namespace pointrt {

class ValidatedDevice {
public:
    ValidatedDevice() : device(create()) {}
    ~ValidatedDevice() {
        destroyDevice(device);
        EXPECT_EQ(validationMessages(), messages_before_);
    }
    ValidatedDevice(const ValidatedDevice&) = delete;
    ValidatedDevice& operator=(const ValidatedDevice&) = delete;

private:
    Device create() {
        setenv("POINTRT_VALIDATION", "1", 1);
        messages_before_ = validationMessages();
        return createDevice({});
    }

    std::uint64_t messages_before_ = 0;

public:
    Device device;
};

/// Tests that need one device each.
class DeviceFixture : public testing::Test {
protected:
    ValidatedDevice validated_;
    Device& device = validated_.device;
};

} // namespace pointrt
