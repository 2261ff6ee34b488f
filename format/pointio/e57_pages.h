// SPDX-License-Identifier: Apache-2.0
// Writes an E57 file in pages: 1020 bytes and their checksum each.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "format/pointio/point_file.h"

namespace pointrt {

class E57Pages {
public:
    explicit E57Pages(PointFile file) : file_(std::move(file)) {}

    static constexpr std::uint64_t kPage = 1024, kPayload = 1020;
    /// The file offset of a byte of the payload.
    static std::uint64_t placeOf(std::uint64_t logical) { return logical / kPayload * kPage + logical % kPayload; }

    std::uint64_t size() const { return size_; } ///< payload bytes so far
    std::uint64_t fileSize() const { return (size_ + kPayload - 1) / kPayload * kPage; }

    void append(std::string_view bytes);
    /// Overwrites bytes of the first page.
    void overwriteFirst(std::size_t at, std::string_view bytes) {
        (first_.empty() ? page_ : first_).replace(at, bytes.size(), bytes);
    }
    /// Writes the last page and the first, and makes the file appear.
    void commit();

private:
    static std::string withChecksum(std::string page);

    PointFile file_;
    std::string first_, page_; ///< the first page, kept until the end, and the last one so far
    std::uint64_t size_ = 0;
};

} // namespace pointrt
