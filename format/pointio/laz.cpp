// SPDX-License-Identifier: Apache-2.0
#include "format/pointio/laz.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <new>

#include "format/pointio/bytes.h"
#include "format/pointio/rust_abi.h"

namespace pointrt {
namespace {

/// The compressor: the first field of the LASzip record.
enum Compressor : std::uint16_t { kAllInOne = 1, kChunked = 2, kLayered = 3 };

/// Offsets in the LASzip record, and its size without items.
constexpr std::size_t kCompressor = 0, kChunkPointsAt = 12, kShortestRecord = 34;
constexpr std::uint32_t kVariable = 0xFFFFFFFF;
/// Bytes of the chunk table offset, which precedes the chunks.
constexpr std::size_t kTableOffset = 8;
/// Bytes of version and number of chunks, which precede the entries of the table.
constexpr std::size_t kTableHead = 8;

/// Identical points compress to 1/3000, scans to 1/4 to 1/20. Files with more than 64 MiB of points that announce a
/// higher ratio than kMostGain are refused, so that a few bytes cannot request any amount of memory.
constexpr std::uint64_t kMostGain = 1000, kFreeBytes = std::uint64_t{64} << 20;

const std::uint8_t* bytesAt(std::string_view bytes) { return reinterpret_cast<const std::uint8_t*>(bytes.data()); }

const LasVlr& laszipVlr(const LasFile& file) {
    const LasVlr* const vlr = findVlr(file, kLaszipUser, kLaszipRecord);
    if (!vlr || vlr->data.size() < kShortestRecord) refuseFile("is compressed, but lacks the record 'laszip encoded'");
    return *vlr;
}

void checkGain(const LasFile& file) {
    const LasHeader& header = file.header;
    const std::uint64_t bytes = file.bytes.size() - header.point_offset;
    const std::uint64_t most = (kFreeBytes + kMostGain * bytes) / header.record_bytes;
    if (header.point_count > most)
        refuseFile(fmt::format("promises {} points, more than its {} bytes can hold", header.point_count, bytes));
}

/// The byte of the chunk table, or 0. Writers to a pipe put its offset at the end of the file.
std::uint64_t tableAt(const LasFile& file) {
    const std::uint64_t first = file.header.point_offset + kTableOffset, size = file.bytes.size();
    if (!liesIn(file.header.point_offset, kTableOffset, size)) refuseFile("ends before its points");
    const auto good = [&](std::int64_t at) {
        return at >= 0 && static_cast<std::uint64_t>(at) >= first &&
               liesIn(static_cast<std::uint64_t>(at), kTableHead, size);
    };
    auto at = loadAt<std::int64_t>(file.bytes, file.header.point_offset);
    if (!good(at)) at = loadAt<std::int64_t>(file.bytes, size - kTableOffset);
    return good(at) ? static_cast<std::uint64_t>(at) : 0;
}

/// A chunk table, not yet validated.
struct Table {
    std::vector<std::uint64_t> counts, sizes;
};

/// Empty if the table is malformed.
Table readTable(const LasFile& file, std::uint64_t at, bool has_counts) {
    Table table;
    const std::string_view bytes = file.bytes.substr(at);
    const auto chunks = loadAt<std::uint32_t>(bytes, 4);
    // a chunk starts with an uncompressed point; a chunk without points may be empty
    if (chunks > 1 + (at - file.header.point_offset) / lasRecordBytes(file.header.point_format)) return table;
    table.counts.resize(chunks);
    table.sizes.resize(chunks);
    scan_error error{};
    if (!scan_laz_read_table(bytesAt(bytes), bytes.size(), has_counts, chunks, table.counts.data(), table.sizes.data(),
                             &error))
        return {};
    return table;
}

/// A single run of chunks of unknown sizes.
void makeRun(const LasFile& file, std::uint64_t at, LazLayout& layout) {
    layout.in_one_run = true;
    layout.chunks = {{at, file.bytes.size() - at, file.header.point_count}};
}

/// The chunks of a table. False if they do not lie within the file.
bool takeTable(const LasFile& file, const Table& table, bool variable, bool salvages, LazLayout& layout) {
    std::uint64_t at = file.header.point_offset + kTableOffset, left = file.header.point_count;
    for (std::size_t i = 0; i < table.sizes.size() && left > 0; ++i) {
        const std::uint64_t points = std::min(left, variable ? table.counts[i] : layout.run_points);
        if (!liesIn(at, table.sizes[i], file.bytes.size())) return false;
        if (points > 0) layout.chunks.push_back({at, table.sizes[i], points});
        at += table.sizes[i];
        left -= points;
    }
    return left == 0 || (salvages && !layout.chunks.empty());
}

bool append(void* text, const std::uint8_t* data, std::size_t bytes) {
    try {
        static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), bytes);
        return true;
    } catch (const std::bad_alloc&) { // must not unwind through Rust
        return false;
    }
}

/// The bytes that work writes through its callback. Our own records are valid, so only the machine can cause a failure.
template <typename Work>
std::string written(const Work& work) {
    std::string text;
    scan_error error{};
    if (!work(append, &text, &error)) throw Error(ExitCode::kCannotRun, fmt::format("LAZ: {}", error.text));
    return text;
}

} // namespace

LazLayout lazLayout(const LasFile& file, bool salvages) {
    LazLayout layout;
    layout.record = laszipVlr(file).data;
    layout.record_bytes = file.header.record_bytes;
    const auto compressor = loadAt<std::uint16_t>(layout.record, kCompressor);
    if (compressor < kAllInOne || compressor > kLayered)
        refuseFile(fmt::format("has an unknown compressor ({})", compressor));
    checkGain(file);
    layout.layered = compressor == kLayered;
    if (compressor == kAllInOne) {
        layout.run_points = std::numeric_limits<std::uint64_t>::max();
        makeRun(file, file.header.point_offset, layout);
        return layout;
    }
    const auto chunk_points = loadAt<std::uint32_t>(layout.record, kChunkPointsAt);
    const bool variable = chunk_points == kVariable || chunk_points == 0;
    layout.run_points = variable ? 0 : chunk_points;
    const std::uint64_t table_at = tableAt(file);
    const Table table = table_at > 0 ? readTable(file, table_at, variable) : Table{};
    if (takeTable(file, table, variable, salvages, layout)) return layout;
    layout.chunks.clear();
    if (variable && !layout.layered) refuseFile("lacks a complete chunk table, which chunks of variable size need");
    makeRun(file, file.header.point_offset + kTableOffset, layout);
    return layout;
}

bool hasLaz() { return true; }

LazStream::LazStream(const LazLayout& layout, std::string_view file, const LazChunk& chunk)
    : layout_(layout), rest_(file.substr(chunk.at, chunk.bytes)),
      chunk_points_(layout.in_one_run ? layout.run_points : chunk.points) {}

LazStream::~LazStream() { scan_laz_close(reader_); }

void LazStream::openNext() {
    if (reader_) {
        rest_.remove_prefix(std::min<std::uint64_t>(scan_laz_consumed(reader_), rest_.size()));
        scan_laz_close(reader_);
        reader_ = nullptr;
    }
    scan_error error{};
    reader_ = scan_laz_open(bytesAt(layout_.record), layout_.record.size(), layout_.record_bytes, bytesAt(rest_),
                            rest_.size(), &error);
    if (!reader_) refuseFile(fmt::format("compressed points: {}", error.text));
    left_in_chunk_ = chunk_points_;
    if (left_in_chunk_ > 0) return;
    if (!liesIn(layout_.record_bytes, 4, rest_.size())) refuseFile("compressed points: is cut short");
    left_in_chunk_ = std::max<std::uint64_t>(1, loadAt<std::uint32_t>(rest_, layout_.record_bytes));
}

void LazStream::read(char* records, std::size_t count) {
    while (count > 0) {
        if (left_in_chunk_ == 0) openNext();
        const std::size_t now = std::min<std::uint64_t>(count, left_in_chunk_);
        scan_error error{};
        if (!scan_laz_read(reader_, reinterpret_cast<std::uint8_t*>(records), now * layout_.record_bytes, &error))
            refuseFile(fmt::format("compressed points: {}", error.text));
        records += now * layout_.record_bytes;
        count -= now;
        left_in_chunk_ -= now;
    }
}

std::string lazRecord(std::uint8_t point_format, std::uint16_t extra_bytes, std::uint32_t chunk_points) {
    return written([&](scan_write write, void* user, scan_error* error) {
        return scan_laz_describe(point_format, extra_bytes, chunk_points, write, user, error);
    });
}

std::string packChunk(std::string_view laz_record, std::string_view records) {
    return written([&](scan_write write, void* user, scan_error* error) {
        return scan_laz_pack(bytesAt(laz_record), laz_record.size(), bytesAt(records), records.size(), write, user,
                             error);
    });
}

std::string packTable(std::string_view laz_record, const std::vector<std::uint64_t>& chunk_points,
                      const std::vector<std::uint64_t>& chunk_bytes) {
    return written([&](scan_write write, void* user, scan_error* error) {
        return scan_laz_pack_table(bytesAt(laz_record), laz_record.size(), chunk_points.data(), chunk_bytes.data(),
                                   chunk_bytes.size(), write, user, error);
    });
}

} // namespace pointrt
