// SPDX-License-Identifier: Apache-2.0
// A profile as JSON and as a table.
#pragma once

#include <string>

#include "runtime/render/pass_profile.h"

namespace pointrt {

/// A JSON object: frames, frames_ms (total), passes (each with pass, runs, device_ms, host_ms, cpu_ms, lanes_in,
/// lanes_out and bytes), host (what and ms) and unaccounted_ms. device_ms is null if the device has no timestamps, and
/// cpu_ms is null if passes are timed within a submission, by the device alone.
std::string profileJson(const PassProfile& profile);

/// The same as a table, slowest pass first.
std::string profileTable(const PassProfile& profile);

} // namespace pointrt
