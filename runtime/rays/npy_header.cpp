// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/npy_header.h"

#include <algorithm>
#include <stdexcept>

#include "format/base/error.h"

namespace pointrt {

namespace {

constexpr std::size_t kAlignment = 64;          // of the first number, as in NumPy
constexpr std::uint32_t kLongestHeader = 65536; // ours have 128 bytes, structured arrays more

} // namespace

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
    const std::size_t fixed = kNpyMagic.size() + 4; // version, and the two bytes of the header's size
    std::size_t bytes = std::max(fixed + text.size() + 1, least);
    bytes = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    text.resize(bytes - fixed - 1, ' ');
    text += '\n';
    const std::size_t size = text.size();
    return std::string(kNpyMagic) + '\x01' + '\0' + static_cast<char>(size & 0xFF) + static_cast<char>(size >> 8) +
           text;
}

} // namespace pointrt
