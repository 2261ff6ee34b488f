// SPDX-License-Identifier: Apache-2.0
// Results of trying to take a lock.
#pragma once

namespace pointrt::format {

enum class LockResult {
    kLocked,      ///< until it is released or the process ends
    kTaken,       ///< another process has the lock
    kUnsupported, ///< locks are not supported here, as on some network file systems
};

} // namespace pointrt::format
