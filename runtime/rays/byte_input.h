// SPDX-License-Identifier: Apache-2.0
// Bytes of a file, a pipe or standard input, from first to last.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointrt {

/// Each function throws Error kBadInput "PATH: reason" where nothing can be read.
class ByteInput {
public:
    /// "-" is standard input.
    explicit ByteInput(std::string path);
    ~ByteInput();
    ByteInput(const ByteInput&) = delete;
    ByteInput& operator=(const ByteInput&) = delete;

    /// "standard input" for "-".
    const std::string& name() const { return name_; }
    /// Up to bytes of them; fewer only at the end.
    std::size_t read(void* to, std::size_t bytes);
    /// Whether the next ones are these, which stay to be read; where there are fewer, they are not.
    bool beginsWith(const std::string& start);

private:
    std::size_t fill(void* to, std::size_t bytes);

    std::string name_;
    int descriptor_ = -1;
    bool owned_ = false;
    std::vector<std::uint8_t> looked_at_; ///< read before they were asked for
};

} // namespace pointrt
