// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace pointrt {

/// Numbers from low to high, both ends included; low <= high, finite.
struct ValueRange {
    double low = 0, high = 1;
    bool operator==(const ValueRange&) const = default;
};

} // namespace pointrt
