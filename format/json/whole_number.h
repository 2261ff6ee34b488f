// SPDX-License-Identifier: Apache-2.0
// Numbers of JSON that may be anybody's.
#pragma once

#include <concepts>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

namespace pointrt {

/// The whole number that a value is. Throws Json::exception, as where there is none, for what Whole cannot hold: get()
/// casts, which a float beyond its range leaves undefined.
template <std::integral Whole, typename Json>
Whole wholeNumber(const Json& value) {
    const bool fits = value.is_number_unsigned()  ? std::in_range<Whole>(value.template get<std::uint64_t>())
                      : value.is_number_integer() ? std::in_range<Whole>(value.template get<std::int64_t>())
                                                  : false;
    if (!fits) throw Json::out_of_range::create(406, "no whole number, or out of range", &value);
    return value.template get<Whole>();
}

} // namespace pointrt
