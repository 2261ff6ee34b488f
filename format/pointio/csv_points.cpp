// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/csv_points.h"

#include <utility>

#include "format/pointio/column_names.h"
#include "format/pointio/number_text.h"

namespace pointrt {
namespace {

constexpr std::size_t kFlushBytes = 1u << 20; // many lines, small compared to a block

class CsvPoints final : public PointSink {
public:
    CsvPoints(PointFile file, const PointOutline& outline) : file_(std::move(file)), columns_(outline.columns) {
        text_ = "x,y,z";
        for (const PointColumn& column : columns_)
            for (const std::string& name : componentNames(column, ",;\"'\\")) text_ += "," + name;
        text_ += '\n';
        flush();
    }

    void add(const PointBlock& block) override {
        for (std::size_t i = 0; i < block.count(); ++i) {
            addNumbers(PRO_TYPE_F64, 3, reinterpret_cast<const std::byte*>(block.positions.data() + 3 * i));
            for (std::size_t k = 0; k < columns_.size(); ++k)
                addNumbers(columns_[k].type, columns_[k].components,
                           block.columns[k].data() + i * columns_[k].rowBytes());
            text_.back() = '\n';
            if (text_.size() >= kFlushBytes) flush();
        }
        flush();
    }

    void finish() override { file_.commit(); }

private:
    void addNumbers(std::uint32_t type, std::uint32_t count, const std::byte* from) {
        for (std::uint32_t c = 0; c < count; ++c) {
            appendNumber(type, from + std::size_t{c} * pro_type_bytes(type), text_);
            text_ += ',';
        }
    }

    void flush() {
        file_.append(text_.data(), text_.size());
        text_.clear();
    }

    PointFile file_;
    std::vector<PointColumn> columns_;
    std::string text_;
};

} // namespace

std::unique_ptr<PointSink> csvPoints(PointFile file, const PointOutline& outline) {
    return std::make_unique<CsvPoints>(std::move(file), outline);
}

} // namespace pointrt
