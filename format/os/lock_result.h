// SPDX-License-Identifier: Apache-2.0
// What came of trying to take a lock.
#pragma once

namespace pointrt::format {

enum class LockResult {
    kLocked,      ///< until it is released or the process ends
    kTaken,       ///< another process has the lock
    kUnsupported, ///< no lock can be had here, as on some network file systems
};

} // namespace pointrt::format
