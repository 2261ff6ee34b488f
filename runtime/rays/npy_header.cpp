// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/npy_header.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "format/base/error.h"

namespace pointrt {

const std::string kNpyMagic = "\x93NUMPY";

namespace {

constexpr std::size_t kAlignment = 64;          // of the first number, as in NumPy
constexpr std::uint32_t kLongestHeader = 65536; // ours have 128 bytes, structured arrays more

[[noreturn]] void fail(const std::string& reason) { throw std::invalid_argument(reason); }

/// The text after 'key': in the dict.
std::string_view valueOf(std::string_view text, const std::string& key) {
    for (const char quote : {'\'', '"'}) {
        const std::string name = quote + key + quote;
        const std::size_t at = text.find(name);
        if (at == text.npos) continue;
        std::string_view rest = text.substr(at + name.size());
        const std::size_t start = rest.find_first_not_of(" :");
        if (start != rest.npos) return rest.substr(start);
    }
    fail("the header lacks " + key);
}

/// A plain type, or the start of a structured type, which matches none of ours.
std::string parseDescr(std::string_view value) {
    const char quote = value.front();
    if (quote != '\'' && quote != '"') return std::string(value.substr(0, value.find('\'')));
    const std::size_t end = value.find(quote, 1);
    if (end == value.npos) fail("truncated header");
    return std::string(value.substr(1, end - 1));
}

std::vector<std::uint64_t> parseShape(std::string_view value) {
    const std::size_t end = value.find(')');
    if (value.front() != '(' || end == value.npos) fail("invalid shape in the header");
    value = value.substr(1, end - 1);
    std::vector<std::uint64_t> shape;
    while (true) {
        const std::size_t start = value.find_first_not_of(" ,L"); // Python 2 wrote 3L
        if (start == value.npos) return shape;
        value.remove_prefix(start);
        std::uint64_t size = 0;
        const auto [rest, error] = std::from_chars(value.data(), value.data() + value.size(), size);
        if (error != std::errc()) fail("invalid shape in the header");
        shape.push_back(size);
        value.remove_prefix(static_cast<std::size_t>(rest - value.data()));
    }
}

} // namespace

NpyHeader parseNpyHeader(std::string_view text) {
    NpyHeader header;
    header.descr = parseDescr(valueOf(text, "descr"));
    const std::string_view order = valueOf(text, "fortran_order");
    if (!order.starts_with("True") && !order.starts_with("False")) fail("invalid fortran_order in the header");
    header.fortran_order = order.starts_with("True");
    header.shape = parseShape(valueOf(text, "shape"));
    return header;
}

NpyHeader readNpyHeader(ByteInput& input) {
    const auto wrong = [&](const std::string& reason) {
        return Error(ExitCode::kBadInput, input.name() + ": " + reason);
    };
    std::uint8_t start[12] = {};
    const std::size_t fixed = kNpyMagic.size() + 2;
    if (input.read(start, fixed) < fixed) throw wrong("truncated in the header");
    const std::uint8_t major = start[kNpyMagic.size()];
    if (major < 1 || major > 3) throw wrong("unknown version of the .npy format");
    const std::size_t bytes_of_size = major == 1 ? 2 : 4;
    if (input.read(start + fixed, bytes_of_size) < bytes_of_size) throw wrong("truncated in the header");
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < bytes_of_size; ++i) size |= static_cast<std::uint32_t>(start[fixed + i]) << 8 * i;
    if (size > kLongestHeader) throw wrong("the header is too long");
    std::string text(size, ' ');
    if (input.read(text.data(), size) < size) throw wrong("truncated in the header");
    try {
        return parseNpyHeader(text);
    } catch (const std::invalid_argument& error) {
        throw wrong(error.what());
    }
}

std::string npyHeader(const std::string& descr, const std::string& shape, std::size_t least) {
    std::string text = "{'descr': " + descr + ", 'fortran_order': False, 'shape': " + shape + ", }";
    const std::size_t fixed = kNpyMagic.size() + 4; // version, and two bytes of size
    std::size_t bytes = std::max(fixed + text.size() + 1, least);
    bytes = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    text.resize(bytes - fixed - 1, ' ');
    text += '\n';
    const std::size_t size = text.size();
    return kNpyMagic + '\x01' + '\0' + static_cast<char>(size & 0xFF) + static_cast<char>(size >> 8) + text;
}

} // namespace pointrt
