// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/npy_header.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "format/pointio/npy_header.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

struct Kind {
    char letter;
    std::size_t size;
    Scalar type;
};
constexpr Kind kKinds[] = {{'f', 4, Scalar::kF32}, {'f', 8, Scalar::kF64}, {'i', 1, Scalar::kI8},
                           {'i', 2, Scalar::kI16}, {'i', 4, Scalar::kI32}, {'i', 8, Scalar::kI64},
                           {'u', 1, Scalar::kU8},  {'u', 2, Scalar::kU16}, {'u', 4, Scalar::kU32},
                           {'u', 8, Scalar::kU64}, {'b', 1, Scalar::kU8}};

/// The size of "<f4" and the like, or of "|V6", which is padding.
struct ElementType {
    std::size_t size = 0;
    std::optional<Scalar> scalar; ///< none: padding
    bool swapped = false;
};

ElementType elementType(const InputFile& input, const std::string& word) {
    constexpr std::size_t kLongestPadding = 1 << 16;
    ElementType type;
    std::string_view rest = word;
    if (!rest.empty() && std::string_view("<>=|").find(rest.front()) != std::string_view::npos) {
        type.swapped = rest.front() == '>';
        rest.remove_prefix(1);
    }
    if (!rest.empty() && wholeInteger(rest.substr(1), type.size)) {
        if (rest.front() == 'V' && type.size <= kLongestPadding) return type;
        for (const Kind& kind : kKinds)
            if (kind.letter == rest.front() && kind.size == type.size) type.scalar = kind.type;
    }
    if (!type.scalar)
        refuse(input, fmt::format("has elements of type {}, which are not integers or floats of 32 or 64 bits",
                                  inQuotes(word)));
    return type;
}

std::uint64_t elementsOf(const InputFile& input, const std::vector<std::uint64_t>& shape) {
    std::uint64_t elements = 1;
    for (const std::uint64_t length : shape)
        if (__builtin_mul_overflow(elements, length, &elements)) refuse(input, "the shape of the array is impossible");
    return elements;
}

/// Appends a field at `size`, the size of an element so far, and adds its own.
void addField(const InputFile& input, const NpyField& header, std::vector<FieldArray>& fields, std::size_t& size) {
    constexpr std::uint64_t kMostComponents = 1 << 16;
    const ElementType type = elementType(input, header.type);
    const std::uint64_t components = elementsOf(input, header.shape);
    if (components == 0 || components > kMostComponents)
        refuse(input, fmt::format("field {} has {} components", inQuotes(header.name), components));
    if (type.scalar) {
        FieldArray field = denseField(header.name, *type.scalar, static_cast<std::uint32_t>(components), nullptr);
        field.stride = size; // temporarily its offset, until the place of the elements is known
        field.swapped = type.swapped;
        fields.push_back(std::move(field));
    }
    size += type.size * components;
}

/// Sets header text; `data` receives the bytes that follow.
std::string_view headerText(const InputFile& input, std::string_view& data) {
    constexpr std::size_t kVersionAt = 6, kLengthAt = 8;
    if (!isNpy(input.bytes) || input.bytes.size() < 12) refuse(input, "is not a NumPy array, or is truncated");
    const bool is_long = input.bytes[kVersionAt] >= 2;
    const auto length = static_cast<std::size_t>(
        loadScalar(input.bytes.data() + kLengthAt, is_long ? Scalar::kU32 : Scalar::kU16, false));
    const std::size_t start = kLengthAt + (is_long ? 4 : 2);
    if (length > input.bytes.size() - start) refuse(input, "the NumPy header is truncated");
    data = input.bytes.substr(start + length);
    return input.bytes.substr(start, length);
}

NpyHeader parsedHeader(const InputFile& input, std::string_view text) {
    try {
        return parseNpyHeader(text);
    } catch (const std::invalid_argument& error) {
        refuse(input, error.what());
    }
}

} // namespace

bool isNpy(std::string_view bytes) { return bytes.starts_with(kNpyMagic); }

NpyArray readNpyHeader(const InputFile& input) {
    std::string_view data;
    const NpyHeader header = parsedHeader(input, headerText(input, data));
    NpyArray array;
    array.shape = header.shape;
    array.fortran_order = header.fortran_order;
    std::size_t size = 0;
    for (const NpyField& field : header.fields) addField(input, field, array.fields, size);
    if (array.fields.empty() || size == 0) refuse(input, "the elements of the NumPy array have no numbers");
    array.elements = elementsOf(input, array.shape);
    array.present = std::min<std::uint64_t>(array.elements, data.size() / size);
    for (FieldArray& field : array.fields) {
        field.first = data.data() + field.stride;
        field.stride = size;
    }
    return array;
}

} // namespace pointrt
