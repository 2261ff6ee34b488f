// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/csv_sink.h"

#include "format/pointio/number_text.h"
#include "pointrt/pro.h"
#include "runtime/util/output_file.h"

namespace pointrt {
namespace {

/// The names of the column's components, separated by commas.
std::string namesOf(const HitColumn& column) {
    if (column.name == "normals") return "nx,ny,nz";
    if (column.name == "positions") return "x,y,z";
    if (column.name == "splat_ids") return "splat_id";
    if (column.name == "instance_ids") return "instance_id";
    if (column.name == "tile_ids") return "tile_id";
    if (column.components == 1) return headerName(column);
    std::string names;
    for (std::uint32_t c = 0; c < column.components; ++c)
        names += (c > 0 ? "," : "") + headerName(column) + "_" + std::to_string(c);
    return names;
}

class CsvSink final : public HitSink {
public:
    CsvSink(const std::string& path, std::span<const HitColumn> columns) : file_(path) {
        for (const HitColumn& column : columns) text_ += (text_.empty() ? "" : ",") + namesOf(column);
        text_ += '\n';
        flush();
    }

    void add(std::span<const HitColumn> columns, std::uint64_t) override {
        const std::size_t count = columns[0].values.size() / columns[0].rowBytes();
        for (std::size_t i = 0; i < count; ++i) {
            for (const HitColumn& column : columns)
                for (std::size_t c = 0; c < column.components; ++c) {
                    const std::size_t number = i * column.components + c;
                    appendNumber(column.type, column.values.data() + number * pro_type_bytes(column.type), text_);
                    text_ += ',';
                }
            text_.back() = '\n';
            if (text_.size() >= kFlushBytes) flush();
        }
        flush();
    }

    void finish() override { file_.commit(); }

private:
    static constexpr std::size_t kFlushBytes = 1u << 20; // many lines, but little compared with a block

    void flush() {
        file_.append({reinterpret_cast<const std::uint8_t*>(text_.data()), text_.size()});
        text_.clear();
    }

    OutputFile file_;
    std::string text_;
};

} // namespace

std::unique_ptr<HitSink> csvSink(const std::string& path, std::span<const HitColumn> columns) {
    return std::make_unique<CsvSink>(path, columns);
}

} // namespace pointrt
