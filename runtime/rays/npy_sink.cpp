// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/npy_sink.h"

#include <cstring>

#include "pointrt/pro_layout.h"
#include "runtime/rays/npy_header.h"
#include "runtime/util/output_file.h"

namespace pointrt {
namespace {

std::string fieldOf(const HitColumn& column) {
    const std::string shape = column.components > 1 ? ", (" + std::to_string(column.components) + ",)" : "";
    return "('" + headerName(column) + "', " + npyDescr(column) + shape + ")";
}

std::string recordDescr(std::span<const HitColumn> columns) {
    if (columns.size() == 1) return npyDescr(columns[0]);
    std::string text = "[";
    for (const HitColumn& column : columns) text += (text.size() > 1 ? ", " : "") + fieldOf(column);
    return text + "]";
}

class NpySink final : public HitSink {
public:
    NpySink(const SinkRequest& request, std::span<const HitColumn> columns)
        : file_(request.path), descr_(recordDescr(columns)), known_(request.count.has_value()) {
        // if the length is unknown, leaves room for the largest one and overwrites the header at the end
        header_bytes_ = header(request.count.value_or(UINT64_MAX), 0).size();
        append(header(request.count.value_or(UINT64_MAX), header_bytes_));
    }

    void add(std::span<const HitColumn> columns, std::uint64_t) override {
        std::size_t record = 0;
        for (const HitColumn& column : columns) record += column.rowBytes();
        const std::size_t count = columns[0].values.size() / columns[0].rowBytes();
        rows_.resize(record * count);
        std::size_t offset = 0;
        for (const HitColumn& column : columns) {
            const std::size_t bytes = column.rowBytes();
            for (std::size_t i = 0; i < count; ++i)
                std::memcpy(rows_.data() + i * record + offset, column.values.data() + i * bytes, bytes);
            offset += bytes;
        }
        file_.append(rows_);
        done_ += count;
    }

    void finish() override {
        if (!known_) {
            const std::string text = header(done_, header_bytes_);
            file_.overwrite(0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
        }
        file_.commit();
    }

private:
    std::string header(std::uint64_t count, std::size_t least) const {
        return npyHeader(descr_, "(" + std::to_string(count) + ",)", least);
    }
    void append(const std::string& text) {
        file_.append({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    }

    OutputFile file_;
    std::string descr_;
    bool known_;
    std::size_t header_bytes_ = 0;
    std::uint64_t done_ = 0;
    std::vector<std::uint8_t> rows_;
};

} // namespace

std::string npyDescr(const HitColumn& column) {
    if (column.is_flag) return "'|b1'";
    constexpr const char* kDescr[] = {"",      "'|i1'", "'|u1'", "'<i2'", "'<u2'", "'<i4'",
                                      "'<u4'", "'<i8'", "'<u8'", "'<f4'", "'<f8'"};
    static_assert(PRO_TYPE_I8 == 1 && PRO_TYPE_U16 == 4 && PRO_TYPE_F64 == 10);
    return kDescr[column.type];
}

std::unique_ptr<HitSink> npySink(const SinkRequest& request, std::span<const HitColumn> columns) {
    return std::make_unique<NpySink>(request, columns);
}

} // namespace pointrt
