// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/result_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/measure/decimal_text.h"

namespace pointrt {
namespace {

std::string valueText(const ResultNumber& number, const SceneUnits& units) {
    constexpr int kDegreeDecimals = 4, kPercentDecimals = 2;
    if (!std::isfinite(number.value)) return "none";
    switch (number.quantity) {
    case Quantity::kCount:
        return decimalText(number.value, 0);
    case Quantity::kShare:
        return decimalText(100 * number.value, kPercentDecimals) + " %";
    case Quantity::kAngle:
        return decimalText(number.value, kDegreeDecimals) + " degrees";
    case Quantity::kLength:
    case Quantity::kArea:
    case Quantity::kVolume:
        break;
    }
    const std::string unit = unitOf(number.quantity, units);
    return decimalText(number.value, units.decimals) + (unit.empty() ? "" : " " + unit);
}

std::string labelOf(const ResultNumber& number) {
    std::string label = number.name;
    std::ranges::replace(label, '_', ' ');
    return label;
}

/// The shortest text that gives the same number.
std::string exactText(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

} // namespace

std::string unitOf(Quantity quantity, const SceneUnits& units) {
    switch (quantity) {
    case Quantity::kLength:
        return units.unit;
    case Quantity::kArea:
        return units.unit.empty() ? "" : units.unit + "2";
    case Quantity::kVolume:
        return units.unit.empty() ? "" : units.unit + "3";
    case Quantity::kAngle:
        return "degrees";
    case Quantity::kCount:
    case Quantity::kShare:
        break;
    }
    return {};
}

std::string resultText(const std::vector<ResultNumber>& numbers, const SceneUnits& units) {
    std::size_t widest = 0;
    for (const ResultNumber& number : numbers) widest = std::max(widest, number.name.size());
    std::string text;
    for (const ResultNumber& number : numbers) {
        const std::string label = labelOf(number);
        text += label + std::string(widest + 2 - label.size(), ' ') + valueText(number, units) + "\n";
    }
    return text;
}

std::string resultCsv(const std::vector<ResultNumber>& numbers, const SceneUnits& units) {
    std::string text = "name,value,unit\n";
    for (const ResultNumber& number : numbers)
        text += number.name + "," + (std::isfinite(number.value) ? exactText(number.value) : "") + "," +
                unitOf(number.quantity, units) + "\n";
    return text;
}

void addResults(const std::vector<ResultNumber>& numbers, const SceneUnits& units, nlohmann::ordered_json& json) {
    for (const ResultNumber& number : numbers) {
        const bool is_count = number.quantity == Quantity::kCount && std::isfinite(number.value);
        if (is_count)
            json[number.name] = static_cast<std::uint64_t>(number.value);
        else
            json[number.name] = number.value; // dumped as null if not finite
    }
    json["unit"] = units.unit.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(units.unit);
    json["metres_per_unit"] = units.metres_per_unit;
}

} // namespace pointrt
