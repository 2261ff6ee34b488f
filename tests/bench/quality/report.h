// SPDX-License-Identifier: Apache-2.0
// Errors as JSON and as a table.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/bench/quality/classify.h"
#include "tests/bench/quality/normals.h"

namespace pointrt::quality {

/// Keys end in the unit; "radii" are median radii of the splats.
nlohmann::ordered_json reportOf(const Discs& discs, const SplatErrors& splats, const ViewErrors& views);

/// One line per figure, names on the left.
std::string tableOf(const nlohmann::ordered_json& report);

} // namespace pointrt::quality
