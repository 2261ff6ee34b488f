// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/npy_header.h"

#include <charconv>
#include <stdexcept>

#include "format/base/printable.h"

namespace pointrt {
namespace {

constexpr std::size_t kMostFields = 256, kMostAxes = 64; // NumPy's own limit of axes

bool isBlank(char letter) { return letter == ' ' || letter == '\t' || letter == '\n' || letter == '\r'; }

/// Parses the Python literals that headers consist of.
struct Literals {
    std::string_view rest;
    std::string key = {}; ///< the key whose value is being parsed, for messages

    bool take(char mark) {
        while (!rest.empty() && isBlank(rest.front())) rest.remove_prefix(1);
        if (rest.empty() || rest.front() != mark) return false;
        rest.remove_prefix(1);
        return true;
    }
    void require(char mark) {
        if (!take(mark)) fail(std::string("expected '") + mark + "'");
    }
    /// Whether another item of a list follows the one before, after a comma; a comma may also precede the end.
    bool takeNext(char end) {
        if (take(',')) return !take(end);
        require(end);
        return false;
    }
    std::string text() {
        const char quote = take('\'') ? '\'' : '"';
        if (quote == '"') require('"');
        const std::size_t length = rest.find(quote);
        if (length == rest.npos) fail("a string has no closing quote");
        std::string word(rest.substr(0, length));
        rest.remove_prefix(length + 1);
        return word;
    }
    std::uint64_t number() {
        take(' ');
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
        if (error != std::errc()) fail("expected a number");
        rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
        if (rest.starts_with('L')) rest.remove_prefix(1); // as Python 2 wrote long integers
        return value;
    }
    bool boolean() {
        take(' ');
        for (const std::string_view word : {"True", "False"})
            if (rest.starts_with(word)) {
                rest.remove_prefix(word.size());
                return word == "True";
            }
        fail("expected True or False");
    }
    [[noreturn]] void fail(const std::string& reason) const {
        throw std::invalid_argument(key + (key.empty() ? "" : ": ") + reason + " at '" + printable(rest.substr(0, 20)) +
                                    "' in the NumPy header");
    }
};

/// "(3, 4)", "(3,)" or "()".
std::vector<std::uint64_t> takeShape(Literals& literals) {
    std::vector<std::uint64_t> shape;
    literals.require('(');
    if (literals.take(')')) return shape;
    do {
        if (shape.size() >= kMostAxes) literals.fail("too many axes");
        shape.push_back(literals.number());
    } while (literals.takeNext(')'));
    return shape;
}

/// "('x', '<f4')", "('rgb', '|u1', (3,))" or "(('title', 'x'), '<f4')".
NpyField takeField(Literals& literals) {
    NpyField field;
    literals.require('(');
    const bool has_title = literals.take('(');
    field.name = literals.text();
    literals.require(',');
    if (has_title) {
        field.name = literals.text();
        literals.require(')');
        literals.require(',');
    }
    if (literals.take('['))
        throw std::invalid_argument("field '" + printable(field.name) +
                                    "' has fields of its own: flatten the array first");
    field.type = literals.text();
    if (!literals.takeNext(')')) return field;
    field.shape = takeShape(literals);
    literals.takeNext(')');
    return field;
}

std::vector<NpyField> takeDescription(Literals& literals) {
    if (!literals.take('[')) return {{"", literals.text(), {}}};
    std::vector<NpyField> fields;
    if (literals.take(']')) literals.fail("a type without fields");
    do {
        if (fields.size() >= kMostFields) literals.fail("more than 256 fields");
        fields.push_back(takeField(literals));
    } while (literals.takeNext(']'));
    return fields;
}

} // namespace

NpyHeader parseNpyHeader(std::string_view text) {
    NpyHeader header;
    bool has_order = false, has_shape = false;
    Literals literals{text};
    literals.require('{');
    do {
        literals.key.clear();
        const std::string key = literals.text();
        literals.require(':');
        literals.key = printable(key);
        if (key == "descr")
            header.fields = takeDescription(literals);
        else if (key == "fortran_order")
            header.fortran_order = literals.boolean();
        else if (key == "shape")
            header.shape = takeShape(literals);
        else
            literals.fail("unknown key");
        has_order = has_order || key == "fortran_order";
        has_shape = has_shape || key == "shape";
    } while (literals.takeNext('}'));
    if (header.fields.empty() || !has_order || !has_shape)
        throw std::invalid_argument("the NumPy header lacks descr, fortran_order or shape");
    return header;
}

} // namespace pointrt
