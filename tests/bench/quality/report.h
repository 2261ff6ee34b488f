// SPDX-License-Identifier: Apache-2.0
// Errors as JSON, and JSON as a table.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/bench/quality/classify.h"
#include "tests/bench/quality/normals.h"

namespace pointrt::quality {

/// Names end in their unit; "radii" are median radii of the splats.
nlohmann::ordered_json reportOf(const Discs& discs, const SplatErrors& splats, const ViewErrors& views);

/// A line for each figure, names left.
std::string tableOf(const nlohmann::ordered_json& report);

} // namespace pointrt::quality
