// SPDX-License-Identifier: Apache-2.0
// The inputs of a .pro, from its metadata.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointrt {

/// Names, without folders, of the files that a .pro was baked from, in order. None if the metadata, which is untrusted,
/// does not list them.
std::optional<std::vector<std::string>> bakeSources(std::string_view metadata);

} // namespace pointrt
