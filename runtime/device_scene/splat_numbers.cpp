// SPDX-License-Identifier: Apache-2.0
#include "runtime/device_scene/splat_numbers.h"

#include <algorithm>
#include <cmath>

#include "runtime/device_scene/render_space.h"

namespace pointrt {
namespace {

template <typename Number>
void readTyped(const SplatNumbers& source, std::size_t first, std::span<double> numbers) {
    const std::size_t step = source.attribute.components;
    const Number* at = static_cast<const Number*>(source.attribute.values) + first * step + source.component;
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<double>(at[i * step]);
}

void readHeights(const SplatNumbers& source, std::size_t first, std::span<double> numbers) {
    const std::uint32_t* words = source.words + first * PRO_SPLAT_WORDS;
    for (std::size_t i = 0; i < numbers.size(); ++i, words += PRO_SPLAT_WORDS) {
        const double x = words[0] & PRO_POSITION_MASK;
        const double y = words[0] >> PRO_POSITION_BITS | (words[1] & PRO_Y_HIGH_MASK) << PRO_Y_LOW_BITS;
        const double z = words[1] >> PRO_Y_HIGH_BITS & PRO_POSITION_MASK;
        numbers[i] = source.bottom + dot(source.height_of_code, {x, y, z});
    }
}

pro_view viewOf(const pro_file* file) {
    pro_view view;
    pro_get_view(file, &view);
    return view;
}

/// Splits "NAME.N"; nullopt if word does not have this form.
std::optional<std::pair<std::string, std::uint32_t>> partedWord(const std::string& word) {
    const std::size_t dot_at = word.rfind('.');
    if (dot_at == std::string::npos || dot_at + 2 != word.size()) return std::nullopt;
    const char digit = word.back();
    if (digit < '0' || digit >= '0' + static_cast<int>(PRO_ATTRIBUTE_COMPONENTS_MAX)) return std::nullopt;
    return std::pair{word.substr(0, dot_at), static_cast<std::uint32_t>(digit - '0')};
}

} // namespace

std::vector<std::string> numberWords(const pro_file* file) {
    std::vector<std::string> words;
    for (std::uint32_t k = 0; k < pro_attribute_count(file); ++k) {
        pro_attribute attribute;
        pro_get_attribute(file, k, &attribute);
        for (std::uint32_t c = 0; c < attribute.components; ++c)
            words.push_back(attribute.name + (attribute.components > 1 ? "." + std::to_string(c) : ""));
    }
    return words;
}

std::string attributeWord(const std::string& word) { return word == "class" ? "classification" : word; }

std::optional<SplatNumbers> attributeNumbers(const pro_file* file, const std::string& word) {
    SplatNumbers numbers;
    const std::string name = pro_find_attribute(file, word.c_str(), &numbers.attribute) ? word : attributeWord(word);
    if (pro_find_attribute(file, name.c_str(), &numbers.attribute) && numbers.attribute.components == 1) return numbers;
    const auto parts = partedWord(name);
    if (!parts || !pro_find_attribute(file, parts->first.c_str(), &numbers.attribute)) return std::nullopt;
    if (parts->second >= numbers.attribute.components) return std::nullopt;
    numbers.component = parts->second;
    return numbers;
}

SplatNumbers heightNumbers(const pro_file* file, const Placement& placement, Vec3 up) {
    pro_info info;
    pro_get_info(file, &info);
    const std::array<Vec3, 3>& r = placement.rotation;
    const Vec3 input_up = placement.scale * (up.x * r[0] + up.y * r[1] + up.z * r[2]);
    SplatNumbers numbers;
    numbers.words = viewOf(file).splats;
    numbers.height_of_code = (info.scale * PRO_POSITION_STEP) * input_up;
    const Vec3 origin{info.origin[0], info.origin[1], info.origin[2]};
    numbers.bottom = dot(up, placement.translation) + dot(input_up, origin) +
                     dot(numbers.height_of_code, {0.5, 0.5, 0.5}); // codes denote the centres of their steps
    return numbers;
}

void readNumbers(const SplatNumbers& source, std::size_t first, std::span<double> numbers) {
    if (!source.attribute.values) return readHeights(source, first, numbers);
    switch (source.attribute.type) {
    case PRO_TYPE_I8:
        return readTyped<std::int8_t>(source, first, numbers);
    case PRO_TYPE_U8:
        return readTyped<std::uint8_t>(source, first, numbers);
    case PRO_TYPE_I16:
        return readTyped<std::int16_t>(source, first, numbers);
    case PRO_TYPE_U16:
        return readTyped<std::uint16_t>(source, first, numbers);
    case PRO_TYPE_I32:
        return readTyped<std::int32_t>(source, first, numbers);
    case PRO_TYPE_U32:
        return readTyped<std::uint32_t>(source, first, numbers);
    case PRO_TYPE_I64:
        return readTyped<std::int64_t>(source, first, numbers);
    case PRO_TYPE_U64:
        return readTyped<std::uint64_t>(source, first, numbers);
    case PRO_TYPE_F32:
        return readTyped<float>(source, first, numbers);
    default:
        return readTyped<double>(source, first, numbers);
    }
}

} // namespace pointrt
