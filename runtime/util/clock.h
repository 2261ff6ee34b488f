// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace pointrt {

using Clock = std::chrono::steady_clock;

inline double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

} // namespace pointrt
