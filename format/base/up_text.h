// SPDX-License-Identifier: Apache-2.0
// How the tools say which way is up.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace pointrt {

/// "up is z, from the scan's ground (change it with --up)" for a direction that no file and no user gave; "" otherwise.
/// @param from "data", "format" or "guess", as in the reports of a bake
/// @param reason the evidence, or the usual convention
std::string upText(const std::array<double, 3>& up, std::string_view from, std::string_view reason);

} // namespace pointrt
