// SPDX-License-Identifier: Apache-2.0
// Range-checked integers from untrusted JSON.
#pragma once

#include <concepts>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace pointrt {

/// The integer in a JSON value; nothing if it is not an integer or out of the range of Whole. get() alone would cast,
/// which is undefined for floats out of range.
template <std::integral Whole, typename Json>
std::optional<Whole> wholeNumberIn(const Json& value) {
    const bool fits = value.is_number_unsigned()  ? std::in_range<Whole>(value.template get<std::uint64_t>())
                      : value.is_number_integer() ? std::in_range<Whole>(value.template get<std::int64_t>())
                                                  : false;
    if (!fits) return std::nullopt;
    return value.template get<Whole>();
}

/// The same, but throws Json::exception, as nlohmann::json does for values of the wrong type.
template <std::integral Whole, typename Json>
Whole wholeNumber(const Json& value) {
    const std::optional<Whole> number = wholeNumberIn<Whole>(value);
    if (!number) throw Json::out_of_range::create(406, "not an integer, or out of range", &value);
    return *number;
}

} // namespace pointrt
