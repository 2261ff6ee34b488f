// SPDX-License-Identifier: Apache-2.0
// Uploads to and downloads from memory that the host cannot reach, through buffers that are kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "runtime/gpu/resources.h"

namespace pointrt {

/// For one thread.
class Staging {
public:
    /// Copies bytes from data to a buffer at offset. Returns the submission that copies them; later submissions see
    /// them. data may be reused at once.
    std::uint64_t upload(Device& device, const Buffer& to, const void* data, std::uint64_t bytes, std::uint64_t offset);
    /// Copies bytes at offset of a buffer to the memory at data.
    void download(Device& device, const Buffer& from, void* data, std::uint64_t bytes, std::uint64_t offset);
    /// Frees the buffers. All submissions must be done.
    void clear(Device& device);

private:
    struct Copy {
        std::uint64_t begin = 0, end = 0; ///< in the ring
        std::uint64_t submission = 0;
    };
    std::uint64_t takeRoom(Device& device, std::uint64_t bytes);
    std::uint64_t submitDownload(Device& device, const Buffer& from, std::uint64_t chunk, std::uint64_t bytes,
                                 std::uint64_t offset);

    Buffer ring_, read_;
    std::uint64_t next_ = 0;  ///< in the ring
    std::deque<Copy> copies_; ///< copies that may be running, oldest first
};

} // namespace pointrt
