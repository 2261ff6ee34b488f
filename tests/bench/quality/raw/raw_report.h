// SPDX-License-Identifier: Apache-2.0
// Figures of pictures as JSON and as a table.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/bench/quality/raw/picture_errors.h"

namespace pointrt::quality {

/// Keys: outline_iou, normal_mean, normal_p99 (degrees), depth_off, false_surface, floating (shares),
/// holes_per_million.
nlohmann::ordered_json figuresOf(const PictureErrors& errors);

/// The mean of each figure. figures: at least one, all with the same keys.
nlohmann::ordered_json meanOf(const std::vector<nlohmann::ordered_json>& figures);

/// A table row: name, figures of all pixels and of scanned ones; the titles without figures.
std::string lineOf(const std::string& name, const nlohmann::ordered_json& all, const nlohmann::ordered_json& seen);
std::string titleLine();

} // namespace pointrt::quality
