// SPDX-License-Identifier: Apache-2.0
// Bytes as text: RFC 4648.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pointrt {

std::string toBase64(std::string_view bytes);

/// Nothing where the text is not what toBase64 writes.
std::optional<std::string> fromBase64(std::string_view text);

} // namespace pointrt
