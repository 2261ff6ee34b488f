// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/points/npy_header.h"

#include <algorithm>
#include <optional>

#include "preprocess/ingest/scalar.h"
#include "preprocess/ingest/text.h"

namespace pointrt {
namespace {

constexpr std::string_view kNpyMark = "\x93NUMPY";

/// Takes the literals of Python that headers consist of.
struct Literals {
    const InputFile& input;
    std::string_view rest;

    void skipBlanks() {
        while (!rest.empty() && isSpace(rest.front())) rest.remove_prefix(1);
    }
    bool take(char mark) {
        skipBlanks();
        if (rest.empty() || rest.front() != mark) return false;
        rest.remove_prefix(1);
        return true;
    }
    void require(char mark) {
        if (!take(mark)) refuseHere(fmt::format("expected '{}'", mark));
    }
    std::string text() {
        const char quote = take('\'') ? '\'' : '"';
        if (quote == '"') require('"');
        const std::size_t length = rest.find(quote);
        if (length == std::string_view::npos) refuseHere("a text does not end");
        const std::string word(rest.substr(0, length));
        rest.remove_prefix(length + 1);
        return word;
    }
    std::uint64_t number() {
        skipBlanks();
        std::size_t length = 0;
        while (length < rest.size() && rest[length] >= '0' && rest[length] <= '9') ++length;
        std::uint64_t value = 0;
        if (!wholeInteger(rest.substr(0, length), value)) refuseHere("expected a number");
        rest.remove_prefix(length);
        if (rest.starts_with('L')) rest.remove_prefix(1); // as Python 2 wrote long integers
        return value;
    }
    bool boolean() {
        skipBlanks();
        for (const std::string_view word : {"True", "False"})
            if (rest.starts_with(word)) {
                rest.remove_prefix(word.size());
                return word == "True";
            }
        refuseHere("expected True or False");
    }
    [[noreturn]] void refuseHere(const std::string& reason) const {
        refuse(input, fmt::format("the NumPy header is malformed: {} at {}", reason, inQuotes(rest.substr(0, 20))));
    }
};

/// "(3, 4)", "(3,)" or "()".
std::vector<std::uint64_t> takeShape(Literals& literals) {
    std::vector<std::uint64_t> shape;
    literals.require('(');
    while (!literals.take(')')) {
        shape.push_back(literals.number());
        if (!literals.take(',')) {
            literals.require(')');
            break;
        }
    }
    return shape;
}

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

/// Appends a field at `size`, the size of an element so far, and adds its own.
void addField(const InputFile& input, const std::string& name, const std::string& word, std::uint64_t components,
              std::vector<FieldArray>& fields, std::size_t& size) {
    constexpr std::uint64_t kMostComponents = 1 << 16;
    const ElementType type = elementType(input, word);
    if (components == 0 || components > kMostComponents)
        refuse(input, fmt::format("field {} has {} components", inQuotes(name), components));
    if (type.scalar) {
        FieldArray field = denseField(name, *type.scalar, static_cast<std::uint32_t>(components), nullptr);
        field.stride = size; // the offset, until the place of the elements is known
        field.swapped = type.swapped;
        fields.push_back(std::move(field));
    }
    size += type.size * components;
}

/// "('x', '<f4')", "('rgb', '|u1', (3,))" or "(('title', 'x'), '<f4')".
void takeField(Literals& literals, std::vector<FieldArray>& fields, std::size_t& size) {
    constexpr std::size_t kMostFields = 256;
    literals.require('(');
    std::string name;
    if (literals.take('(')) {
        literals.text();
        literals.require(',');
        name = literals.text();
        literals.require(')');
    } else {
        name = literals.text();
    }
    literals.require(',');
    if (literals.take('['))
        refuse(literals.input, fmt::format("field {} has fields of its own: flatten the array first", inQuotes(name)));
    const std::string word = literals.text();
    std::uint64_t components = 1;
    if (!literals.take(')')) {
        literals.require(',');
        if (!literals.take(')')) {
            for (const std::uint64_t length : takeShape(literals))
                if (__builtin_mul_overflow(components, length, &components)) literals.refuseHere("impossible shape");
            literals.take(',');
            literals.require(')');
        }
    }
    if (fields.size() >= kMostFields) refuse(literals.input, fmt::format("has more than {} fields", kMostFields));
    addField(literals.input, name, word, components, fields, size);
}

/// Returns the size of an element.
std::size_t takeDescription(Literals& literals, std::vector<FieldArray>& fields) {
    std::size_t size = 0;
    if (!literals.take('[')) {
        addField(literals.input, "", literals.text(), 1, fields, size);
        return size;
    }
    while (!literals.take(']')) {
        takeField(literals, fields, size);
        if (!literals.take(',')) {
            literals.require(']');
            break;
        }
    }
    return size;
}

/// The text of the header; `data` is what follows.
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

std::uint64_t elementsOf(const InputFile& input, const std::vector<std::uint64_t>& shape) {
    std::uint64_t elements = 1;
    for (const std::uint64_t length : shape)
        if (__builtin_mul_overflow(elements, length, &elements)) refuse(input, "the shape of the array is impossible");
    return elements;
}

} // namespace

bool isNpy(std::string_view bytes) { return bytes.starts_with(kNpyMark); }

NpyArray readNpyHeader(const InputFile& input) {
    NpyArray array;
    std::string_view data;
    Literals literals{input, headerText(input, data)};
    std::size_t size = 0;
    bool has_shape = false;
    literals.require('{');
    while (!literals.take('}')) {
        const std::string key = literals.text();
        literals.require(':');
        if (key == "descr") {
            array.fields.clear();
            size = takeDescription(literals, array.fields);
        } else if (key == "fortran_order") {
            array.fortran_order = literals.boolean();
        } else if (key == "shape") {
            array.shape = takeShape(literals);
            has_shape = true;
        } else {
            literals.refuseHere(fmt::format("unknown key {}", inQuotes(key)));
        }
        if (!literals.take(',')) {
            literals.require('}');
            break;
        }
    }
    if (array.fields.empty() || size == 0 || !has_shape) refuse(input, "the NumPy header has no type or no shape");
    array.elements = elementsOf(input, array.shape);
    array.present = std::min<std::uint64_t>(array.elements, data.size() / size);
    for (FieldArray& field : array.fields) {
        field.first = data.data() + field.stride;
        field.stride = size;
    }
    return array;
}

} // namespace pointrt
