// SPDX-License-Identifier: Apache-2.0
// Hits as NPZ: an array for each column.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "runtime/rays/hit_sink.h"

namespace pointrt {

std::unique_ptr<HitSink> npzSink(const std::string& path, std::span<const HitColumn> columns);

} // namespace pointrt
