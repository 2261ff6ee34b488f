// SPDX-License-Identifier: Apache-2.0
// Hits as NumPy arrays: what one column is called there, and all of them as one array of records.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "runtime/rays/hit_sink.h"

namespace pointrt {

/// "'<f8'"
std::string npyDescr(const HitColumn& column);

/// One column alone is a plain array (--any); several are the fields of records.
std::unique_ptr<HitSink> npySink(const SinkRequest& request, std::span<const HitColumn> columns);

} // namespace pointrt
