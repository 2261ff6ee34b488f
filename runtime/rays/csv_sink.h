// SPDX-License-Identifier: Apache-2.0
// Hits as CSV: a line with column names, then one for each ray.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "runtime/rays/hit_sink.h"

namespace pointrt {

std::unique_ptr<HitSink> csvSink(const std::string& path, std::span<const HitColumn> columns);

} // namespace pointrt
