// SPDX-License-Identifier: Apache-2.0
// A number for each splat of a scan: an attribute or its height.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pointrt/pro.h"
#include "runtime/scene/scene_description.h"

namespace pointrt {

/// Where to read the numbers. Plain data, valid while the file is open.
struct SplatNumbers {
    pro_attribute attribute{}; ///< its values are null for heights
    std::uint32_t component = 0;
    const std::uint32_t* words = nullptr; ///< PRO_SPLAT_WORDS per splat
    Vec3 height_of_code;                  ///< height = bottom + dot(height_of_code, position codes)
    double bottom = 0;
};

/// Names of the numbers in a file, in its order: "NAME", or "NAME.0" to "NAME.3" for attributes with components.
std::vector<std::string> numberWords(const pro_file* file);

/// The attribute name that word abbreviates, else word itself.
std::string attributeWord(const std::string& word);

/// The numbers that word names or abbreviates; nullopt if the file has none.
std::optional<SplatNumbers> attributeNumbers(const pro_file* file, const std::string& word);

/// Heights along up (unit length), in world units; for an unmoved scan, the heights of its input.
SplatNumbers heightNumbers(const pro_file* file, const Placement& placement, Vec3 up);

/// Reads the numbers of splats first to first + numbers.size() - 1.
void readNumbers(const SplatNumbers& source, std::size_t first, std::span<double> numbers);

} // namespace pointrt
