// SPDX-License-Identifier: Apache-2.0
// One number for each splat of a scan: an attribute's, or how high it lies.
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

/// Plain data, good as long as the file is open.
struct SplatNumbers {
    pro_attribute attribute{}; ///< whose component these are; without values: heights
    std::uint32_t component = 0;
    const std::uint32_t* words = nullptr; ///< PRO_SPLAT_WORDS a splat
    Vec3 height_of_code;                  ///< height = bottom + dot of this and the position's codes
    double bottom = 0;
};

/// Words for the numbers that a file has, in its order: "NAME", or "NAME.0" to "NAME.3" where a splat has several.
std::vector<std::string> numberWords(const pro_file* file);

/// The attribute's name that word is short for, or word.
std::string attributeWord(const std::string& word);

/// What word names in file, or what it is short for; nothing where the file has neither.
std::optional<SplatNumbers> attributeNumbers(const pro_file* file, const std::string& word);

/// Heights along up, a unit vector, in world units: of what stands at its own coordinates those of its input.
SplatNumbers heightNumbers(const pro_file* file, const Placement& placement, Vec3 up);

/// The numbers of splats first to first + numbers.size().
void readNumbers(const SplatNumbers& source, std::size_t first, std::span<double> numbers);

} // namespace pointrt
