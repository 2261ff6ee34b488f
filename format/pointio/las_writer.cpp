// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/las_writer.h"

#include <algorithm>
#include <limits>

#include "format/base/parallel.h"
#include "format/pointio/bytes.h"
#include "format/pointio/laz.h"

namespace pointrt {
namespace {

/// Points per chunk, as in LASzip.
constexpr std::size_t kChunkPoints = 50000;
/// Chunks compressed in parallel.
constexpr std::size_t kChunksAtOnce = 8;

template <typename Number>
void store(std::string& bytes, std::size_t at, Number number) {
    std::memcpy(bytes.data() + at, &number, sizeof number);
}

std::size_t headerSize(std::uint8_t version_minor) { return version_minor >= 4 ? 375 : version_minor == 3 ? 235 : 227; }

/// Text of a field, cut off or padded with zeros.
void appendField(std::string& bytes, const std::string& text, std::size_t size) {
    bytes += text.substr(0, size);
    bytes.append(size - std::min(size, text.size()), '\0');
}

std::string recordHead(const LasSource::Record& record, bool extended) {
    std::string head(2, '\0');
    appendField(head, record.vlr.user_id, 16);
    head.append(extended ? 10 : 4, '\0');
    store(head, 18, record.vlr.record_id);
    if (extended)
        store(head, 20, std::uint64_t{record.data.size()});
    else
        store(head, 20, static_cast<std::uint16_t>(record.data.size()));
    appendField(head, record.vlr.description, 32);
    return head;
}

/// Whether a record goes after the points, which needs version 1.4.
bool isBehind(const LasSource::Record& record, const LasHeader& header) {
    const bool is_long = record.data.size() > std::numeric_limits<std::uint16_t>::max();
    return header.version_minor >= 4 && (record.vlr.extended || is_long);
}

LasSource::Record laszipRecord(const std::string& payload) {
    LasSource::Record record;
    record.vlr.user_id = kLaszipUser;
    record.vlr.record_id = kLaszipRecord;
    record.data = payload;
    return record;
}

} // namespace

LasWriter::LasWriter(const LasDescription& description, LasTarget target)
    : description_(description), target_(std::move(target)) {
    low_.fill(std::numeric_limits<std::int32_t>::max());
    high_.fill(std::numeric_limits<std::int32_t>::min());
    const LasHeader& header = description_.header;
    if (header.packed) {
        const auto extra = static_cast<std::uint16_t>(header.record_bytes - lasRecordBytes(header.point_format));
        laszip_ = lazRecord(header.point_format, extra, kChunkPoints);
        description_.records.insert(description_.records.begin(), laszipRecord(laszip_));
    }
    // omits records that are too long for older versions
    std::erase_if(description_.records, [&](const LasSource::Record& record) {
        return !isBehind(record, header) && record.data.size() > std::numeric_limits<std::uint16_t>::max();
    });
}

bool LasWriter::put(const void* data, std::size_t bytes) {
    at_ += bytes;
    return target_.write(data, bytes);
}

bool LasWriter::putRecord(const LasSource::Record& record) {
    const std::string head = recordHead(record, isBehind(record, description_.header));
    return put(head.data(), head.size()) && put(record.data.data(), record.data.size());
}

/// Writes a preliminary header, the records, and room for the offset of LAZ's chunk table.
bool LasWriter::begin() {
    std::string head = headerBytes();
    if (!put(head.data(), head.size())) return false;
    for (const LasSource::Record& record : description_.records)
        if (!isBehind(record, description_.header) && !putRecord(record)) return false;
    point_offset_ = static_cast<std::uint32_t>(at_);
    const std::int64_t table = -1;
    return !description_.header.packed || put(&table, sizeof table);
}

void LasWriter::countPoint(const char* record) {
    const auto returns = static_cast<std::uint8_t>(record[14]);
    const int number = description_.header.point_format < 6 ? returns & 7 : returns & 15;
    if (number > 0) ++returns_[static_cast<std::size_t>(number - 1)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::int32_t integer;
        std::memcpy(&integer, record + 4 * axis, sizeof integer);
        low_[axis] = std::min(low_[axis], integer);
        high_[axis] = std::max(high_[axis], integer);
    }
}

/// Compresses full chunks in parallel; with last, the final one, too.
bool LasWriter::packFull(bool last) {
    const std::size_t bytes = kChunkPoints * description_.header.record_bytes;
    const std::size_t chunks = last ? (pending_.size() + bytes - 1) / bytes : pending_.size() / bytes;
    std::vector<std::string> packed(chunks);
    forAll(chunks, [&](std::size_t k) {
        const std::size_t size = std::min(bytes, pending_.size() - k * bytes);
        packed[k] = packChunk(laszip_, std::string_view(pending_.data() + k * bytes, size));
    });
    for (const std::string& chunk : packed) {
        if (!put(chunk.data(), chunk.size())) return false;
        chunk_points_.push_back(kChunkPoints);
        chunk_bytes_.push_back(chunk.size());
    }
    pending_.erase(pending_.begin(),
                   pending_.begin() + static_cast<std::ptrdiff_t>(std::min(chunks * bytes, pending_.size())));
    return true;
}

bool LasWriter::add(const char* records, std::size_t count) {
    if (point_offset_ == 0 && !begin()) return false;
    const LasHeader& header = description_.header;
    count_ += count;
    for (std::size_t i = 0; i < count; ++i) countPoint(records + i * header.record_bytes);
    const std::size_t bytes = count * header.record_bytes;
    if (!header.packed) return put(records, bytes);
    pending_.insert(pending_.end(), records, records + bytes);
    return pending_.size() < kChunksAtOnce * kChunkPoints * header.record_bytes || packFull(false);
}

bool LasWriter::finish() {
    if (point_offset_ == 0 && !begin()) return false;
    if (description_.header.packed) {
        if (!packFull(true)) return false;
        const std::uint64_t table_at = at_;
        const std::string table = packTable(laszip_, chunk_points_, chunk_bytes_);
        if (!put(table.data(), table.size()) || !target_.overwrite(point_offset_, &table_at, sizeof table_at))
            return false;
    }
    for (const LasSource::Record& record : description_.records) {
        if (!isBehind(record, description_.header)) continue;
        if (evlr_offset_ == 0) evlr_offset_ = at_;
        if (!putRecord(record)) return false;
    }
    const std::string head = headerBytes();
    return target_.overwrite(0, head.data(), head.size());
}

std::string LasWriter::headerBytes() const {
    const LasHeader& header = description_.header;
    std::string bytes = description_.header_bytes.substr(0, 227); // fields of 1.3 and 1.4 are set below
    bytes.resize(headerSize(header.version_minor), '\0');
    bytes.replace(0, 4, "LASF");
    const auto behind =
        static_cast<std::uint32_t>(std::count_if(description_.records.begin(), description_.records.end(),
                                                 [&](const auto& each) { return isBehind(each, header); }));
    store(bytes, 6, header.global_encoding);
    store(bytes, 24, std::uint8_t{1});
    store(bytes, 25, header.version_minor);
    store(bytes, 94, static_cast<std::uint16_t>(bytes.size()));
    store(bytes, 96, point_offset_);
    store(bytes, 100, static_cast<std::uint32_t>(description_.records.size() - behind));
    store(bytes, 104, static_cast<std::uint8_t>(header.point_format | (header.packed ? 0x80 : 0)));
    store(bytes, 105, header.record_bytes);
    // 32-bit counts, if the point format and the number of points permit
    const bool has_old_counts = header.point_format < 6 && count_ <= std::numeric_limits<std::uint32_t>::max();
    store(bytes, 107, static_cast<std::uint32_t>(has_old_counts ? count_ : 0));
    for (std::size_t i = 0; i < 5; ++i)
        store(bytes, 111 + 4 * i, static_cast<std::uint32_t>(has_old_counts ? returns_[i] : 0));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        store(bytes, 131 + 8 * axis, header.scale[axis]);
        store(bytes, 155 + 8 * axis, header.offset[axis]);
        const bool any = low_[axis] <= high_[axis];
        const double a = any ? header.offset[axis] + header.scale[axis] * low_[axis] : 0;
        const double b = any ? header.offset[axis] + header.scale[axis] * high_[axis] : 0;
        store(bytes, 179 + 16 * axis, std::max(a, b)); // a scale may be negative
        store(bytes, 187 + 16 * axis, std::min(a, b));
    }
    if (header.version_minor < 4) return bytes;
    store(bytes, 235, evlr_offset_);
    store(bytes, 243, behind);
    store(bytes, 247, count_);
    for (std::size_t i = 0; i < returns_.size(); ++i) store(bytes, 255 + 8 * i, returns_[i]);
    return bytes;
}

} // namespace pointrt
