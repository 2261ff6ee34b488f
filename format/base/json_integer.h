// SPDX-License-Identifier: Apache-2.0
// Range-checked integers from untrusted JSON.
#pragma once

#include <concepts>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace pointrt {

/// The integer in a JSON value; nothing if it is not an integer or out of the range of Integer. get() alone would cast,
/// which is undefined for floats out of range.
template <std::integral Integer, typename Json>
std::optional<Integer> optionalJsonInteger(const Json& value) {
    const bool fits = value.is_number_unsigned()  ? std::in_range<Integer>(value.template get<std::uint64_t>())
                      : value.is_number_integer() ? std::in_range<Integer>(value.template get<std::int64_t>())
                                                  : false;
    if (!fits) return std::nullopt;
    return value.template get<Integer>();
}

/// The same, but throws Json::exception, as nlohmann::json does for values of the wrong type.
template <std::integral Integer, typename Json>
Integer jsonInteger(const Json& value) {
    const std::optional<Integer> number = optionalJsonInteger<Integer>(value);
    if (!number) throw Json::out_of_range::create(406, "not an integer, or out of range", &value);
    return *number;
}

} // namespace pointrt
