// SPDX-License-Identifier: Apache-2.0
// How long this process has been running.
#pragma once

namespace pointrt {

/// Seconds since this process started, according to the system (Linux: in steps of 10 ms); if the system does not
/// report it, since the first call.
double secondsSinceStart();

} // namespace pointrt
