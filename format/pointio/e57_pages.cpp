// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/e57_pages.h"

#include <algorithm>
#include <array>

namespace pointrt {
namespace {

constexpr std::array<std::uint32_t, 256> crc32cTable() {
    constexpr std::uint32_t kReversedPolynomial = 0x82F63B78u;
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
        std::uint32_t sum = byte;
        for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ ((sum & 1) != 0 ? kReversedPolynomial : 0);
        table[byte] = sum;
    }
    return table;
}

std::uint32_t crc32c(std::string_view bytes) {
    static constexpr std::array<std::uint32_t, 256> kTable = crc32cTable();
    std::uint32_t sum = ~0u;
    for (const char byte : bytes) sum = sum >> 8 ^ kTable[(sum ^ static_cast<unsigned char>(byte)) & 255];
    return ~sum;
}

} // namespace

std::string E57Pages::withChecksum(std::string page) {
    page.resize(kPayload, '\0');
    const std::uint32_t sum = crc32c(page);
    for (int shift = 24; shift >= 0; shift -= 8) page += static_cast<char>(sum >> shift & 255); // big-endian
    return page;
}

void E57Pages::append(std::string_view bytes) {
    size_ += bytes.size();
    while (!bytes.empty()) {
        const std::size_t taken = std::min<std::size_t>(bytes.size(), kPayload - page_.size());
        page_ += bytes.substr(0, taken);
        bytes.remove_prefix(taken);
        if (page_.size() < kPayload) continue;
        if (first_.empty()) first_ = page_;
        const std::string page = withChecksum(std::move(page_));
        file_.append(page.data(), page.size());
        page_.clear();
    }
}

void E57Pages::commit() {
    if (!page_.empty()) append(std::string(kPayload - page_.size(), '\0'));
    const std::string page = withChecksum(first_);
    file_.overwrite(0, page.data(), page.size());
    file_.commit();
}

} // namespace pointrt
