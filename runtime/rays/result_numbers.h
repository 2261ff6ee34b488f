// SPDX-License-Identifier: Apache-2.0
// Named numbers with units: the results of commands that print them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runtime/rays/scene_units.h"

namespace pointrt {

enum class Quantity { kCount, kShare, kLength, kArea, kVolume, kAngle };

struct ResultNumber {
    std::string name; ///< "plan_area"
    double value = 0;
    Quantity quantity = Quantity::kLength;
};

/// "m2"; "degrees"; "" for counts and unknown units.
std::string unitOf(Quantity quantity, const SceneUnits& units);

/// Lines for people: "plan area  16.000 m2"; shares in percent.
std::string resultText(const std::vector<ResultNumber>& numbers, const SceneUnits& units);
/// "name,value,unit" and a line for each number, with all digits.
std::string resultCsv(const std::vector<ResultNumber>& numbers, const SceneUnits& units);
/// Adds the numbers as members, null if not finite, and unit and metres_per_unit.
void addResults(const std::vector<ResultNumber>& numbers, const SceneUnits& units, nlohmann::ordered_json& json);

} // namespace pointrt
