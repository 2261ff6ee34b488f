// SPDX-License-Identifier: Apache-2.0
// Base64 (RFC 4648).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pointrt {

std::string toBase64(std::string_view bytes);

/// nullopt if text does not have the form that toBase64 writes.
std::optional<std::string> fromBase64(std::string_view text);

} // namespace pointrt
