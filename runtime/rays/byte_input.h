// SPDX-License-Identifier: Apache-2.0
// Sequential reading of a file, a pipe or standard input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointrt {

/// Every function throws Error kBadInput "PATH: reason" if reading fails.
class ByteInput {
public:
    /// "-" is standard input.
    explicit ByteInput(std::string path);
    ~ByteInput();
    ByteInput(const ByteInput&) = delete;
    ByteInput& operator=(const ByteInput&) = delete;

    /// "standard input" for "-".
    const std::string& name() const { return name_; }
    /// Reads up to bytes bytes; fewer only at the end of the input.
    std::size_t read(void* to, std::size_t bytes);
    /// Peeks at the next bytes. False if fewer than these are left.
    bool beginsWith(const std::string& start);

private:
    std::size_t fill(void* to, std::size_t bytes);

    std::string name_;
    int descriptor_ = -1;
    bool owned_ = false;
    std::vector<std::uint8_t> peeked_; ///< read ahead by beginsWith
};

} // namespace pointrt
