// SPDX-License-Identifier: Apache-2.0
// Hits as PLY: the points that were hit, with all columns and the index of their ray.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "runtime/rays/hit_sink.h"

namespace pointrt {

std::unique_ptr<HitSink> plySink(const std::string& path, std::span<const HitColumn> columns);

} // namespace pointrt
