// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/ingest/json_value.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "format/base/json_integer.h"
#include "format/base/printable.h"

namespace pointrt {

nlohmann::json parseJson(const InputFile& input, std::string_view text) {
    nlohmann::json json = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
    if (json.is_discarded()) refuse(input, "is not valid JSON, or is truncated");
    return json;
}

bool JsonValue::has(const char* key) const {
    if (!value_->is_object()) return false;
    const auto found = value_->find(key);
    return found != value_->end() && !found->is_null();
}

JsonValue JsonValue::member(const char* key) const {
    const std::string name = printable(key); // of a table in a PNTS file, whose names may be arbitrary
    const std::string place = place_.empty() ? name : place_ + "." + name;
    if (!has(key)) refuseAt(*input_, place, "is missing");
    return {*input_, *value_->find(key), place};
}

std::optional<JsonValue> JsonValue::optionalMember(const char* key) const {
    if (!has(key)) return std::nullopt;
    return member(key);
}

std::size_t JsonValue::size() const {
    if (!value_->is_array()) refuse("must be an array");
    return value_->size();
}

JsonValue JsonValue::at(std::size_t index) const {
    if (index >= size()) refuse(fmt::format("has {} items, index {} is out of range", size(), index));
    return {*input_, (*value_)[index], fmt::format("{}[{}]", place_, index)};
}

double JsonValue::number() const {
    const double value = value_->is_number() ? value_->get<double>() : std::nan("");
    if (!std::isfinite(value)) refuse("must be a number");
    return value;
}

std::uint64_t JsonValue::integer(std::uint64_t most) const {
    const auto value = optionalJsonInteger<std::uint64_t>(*value_);
    if (!value || *value > most) refuse(fmt::format("must be an integer from 0 to {}", most));
    return *value;
}

const std::string& JsonValue::text() const {
    if (!value_->is_string()) refuse("must be a string");
    return value_->get_ref<const std::string&>();
}

bool JsonValue::boolean() const {
    if (!value_->is_boolean()) refuse("must be true or false");
    return value_->get<bool>();
}

bool JsonValue::isNull() const { return value_->is_null(); }

void JsonValue::refuse(const std::string& reason) const {
    if (place_.empty()) pointrt::refuse(*input_, reason);
    refuseAt(*input_, place_, reason);
}

} // namespace pointrt
