// SPDX-License-Identifier: Apache-2.0
// Hits as a NumPy array.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "runtime/rays/hit_sink.h"

namespace pointrt {

/// The type of a column as .npy headers have it, with quotes: "'<f8'".
std::string npyDescr(const HitColumn& column);

/// Several columns become the fields of a structured array; a single one (--any) a plain array.
std::unique_ptr<HitSink> npySink(const SinkRequest& request, std::span<const HitColumn> columns);

} // namespace pointrt
