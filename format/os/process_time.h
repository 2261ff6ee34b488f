// SPDX-License-Identifier: Apache-2.0
// How long this process has been running.
#pragma once

namespace pointrt {

/// Seconds since the start of this process, from the system (Linux: in steps of 10 ms); if that does not tell, since
/// the first call.
double secondsSinceStart();

} // namespace pointrt
