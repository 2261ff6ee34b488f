// SPDX-License-Identifier: Apache-2.0
// Whole numbers of JSON that may be anybody's.
#pragma once

#include <concepts>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace pointrt {

/// The whole number that a value is; nothing where it is none, or one that Whole cannot hold: get() casts, which a
/// float beyond its range leaves undefined.
template <std::integral Whole, typename Json>
std::optional<Whole> wholeNumberIn(const Json& value) {
    const bool fits = value.is_number_unsigned()  ? std::in_range<Whole>(value.template get<std::uint64_t>())
                      : value.is_number_integer() ? std::in_range<Whole>(value.template get<std::int64_t>())
                                                  : false;
    if (!fits) return std::nullopt;
    return value.template get<Whole>();
}

/// The same. Throws Json::exception where there is none, as for other values that are not what they should be.
template <std::integral Whole, typename Json>
Whole wholeNumber(const Json& value) {
    const std::optional<Whole> number = wholeNumberIn<Whole>(value);
    if (!number) throw Json::out_of_range::create(406, "no whole number, or out of range", &value);
    return *number;
}

} // namespace pointrt
