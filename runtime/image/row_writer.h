// SPDX-License-Identifier: Apache-2.0
// Picture files that are written row by row.
#pragma once

#include <cstdint>
#include <span>

namespace pointrt {

class RowWriter {
public:
    virtual ~RowWriter() = default;
    /// Appends whole rows, from the top. Throws Error kCannotWrite "PATH: reason", as finish does.
    virtual void addRows(std::span<const std::uint8_t> rows) = 0;
    /// Must be called after the last row.
    virtual void finish() = 0;
};

} // namespace pointrt
