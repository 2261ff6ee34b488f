// SPDX-License-Identifier: Apache-2.0
// Where a .pro comes from, as its metadata has it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// The names, without folders, of the files that a .pro with this metadata was baked from, in their order. Nothing
/// where the metadata does not say: it may be anyone's, and any bytes.
std::optional<std::vector<std::string>> bakeSources(std::string_view metadata);

} // namespace pointrt
