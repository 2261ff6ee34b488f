// SPDX-License-Identifier: Apache-2.0
// A profile for people and for programs.
#pragma once

#include <string>

#include "runtime/render/pass_profile.h"

namespace pointrt {

/// A JSON object: frames, frames_ms of all of them, passes (each with its name, runs, device_ms, host_ms, cpu_ms,
/// lanes_in, lanes_out and bytes), host (name and ms) and unaccounted_ms. device_ms is null where the device keeps no
/// time.
std::string profileJson(const PassProfile& profile);

/// The same as a table, what took most first.
std::string profileTable(const PassProfile& profile);

} // namespace pointrt
