// SPDX-License-Identifier: Apache-2.0
// Files of a header and a row of bytes for each point.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "format/pointio/point_file.h"
#include "format/pointio/point_sink.h"

namespace pointrt {

/// The bytes of rows.
struct RowBytes {
    std::vector<char> bytes;

    void add(const void* from, std::size_t count) {
        const auto* const first = static_cast<const char*>(from);
        bytes.insert(bytes.end(), first, first + count);
    }
};

/// Writes points in a format that has
///   const PointOutline& outline() const;
///   std::string header(std::uint64_t count) const;  // equally long for any count if outline().count is unknown
///   void addRow(const PointBlock& block, std::size_t point, RowBytes& rows) const;
template <typename Format>
class RowPoints final : public PointSink {
public:
    RowPoints(PointFile file, Format format) : file_(std::move(file)), format_(std::move(format)) {
        const std::string text = format_.header(format_.outline().count.value_or(0));
        file_.append(text.data(), text.size());
    }

    void add(const PointBlock& block) override {
        constexpr std::size_t kRowsAtOnce = 16384; // each has at most some hundred bytes
        for (std::size_t i = 0; i < block.count(); ++i) {
            format_.addRow(block, i, rows_);
            if ((i + 1) % kRowsAtOnce == 0) flush();
        }
        flush();
        count_ += block.count();
    }

    void finish() override {
        if (!format_.outline().count) {
            const std::string text = format_.header(count_);
            file_.overwrite(0, text.data(), text.size());
        }
        file_.commit();
    }

private:
    void flush() {
        file_.append(rows_.bytes.data(), rows_.bytes.size());
        rows_.bytes.clear();
    }

    PointFile file_;
    Format format_;
    RowBytes rows_;
    std::uint64_t count_ = 0;
};

} // namespace pointrt
