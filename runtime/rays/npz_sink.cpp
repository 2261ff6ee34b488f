// SPDX-License-Identifier: Apache-2.0
#include "runtime/rays/npz_sink.h"

#include <zlib.h>

#include <initializer_list>
#include <vector>

#include "runtime/rays/npy_header.h"
#include "runtime/rays/npy_sink.h"
#include "runtime/rays/spool_file.h"

namespace pointrt {
namespace {

/// Little-endian records of a zip file (PKWARE APPNOTE 6.3.4, sections 4.3 to 4.5). All sizes are written as Zip64,
/// which every reader of NumPy arrays supports, so that one layout serves every size.
class ZipRecord {
public:
    ZipRecord& u16(std::initializer_list<unsigned> numbers) {
        for (const unsigned number : numbers) put(number, 2);
        return *this;
    }
    ZipRecord& u32(std::initializer_list<std::uint32_t> numbers) {
        for (const std::uint32_t number : numbers) put(number, 4);
        return *this;
    }
    ZipRecord& u64(std::initializer_list<std::uint64_t> numbers) {
        for (const std::uint64_t number : numbers) put(number, 8);
        return *this;
    }
    ZipRecord& text(const std::string& words) {
        bytes.insert(bytes.end(), words.begin(), words.end());
        return *this;
    }

    std::vector<std::uint8_t> bytes;

private:
    void put(std::uint64_t number, int count) {
        for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(number >> 8 * i));
    }
};

constexpr unsigned kVersion = 45;      // needed to extract: Zip64
constexpr unsigned kStored = 0;        // uncompressed: hits hardly compress
constexpr unsigned kDate = 1 << 5 | 1; // 1980-01-01, so that equal hits give equal bytes
constexpr unsigned kZip64 = 1;         // ID of the extra field
constexpr std::uint32_t kIsIn64 = ~0u; // in a 32-bit size field: see the Zip64 field
constexpr unsigned kUtf8 = 1 << 11;    // attributes may have non-ASCII names

struct Member {
    std::string name;
    std::uint32_t checksum = 0;
    std::uint64_t size = 0, offset = 0;
};

std::vector<std::uint8_t> localHeader(const Member& member) {
    const auto length = static_cast<unsigned>(member.name.size());
    return ZipRecord()
        .u32({0x04034B50})
        .u16({kVersion, kUtf8, kStored, 0, kDate})
        .u32({member.checksum, kIsIn64, kIsIn64})
        .u16({length, 20})
        .text(member.name)
        .u16({kZip64, 16})
        .u64({member.size, member.size})
        .bytes;
}

std::vector<std::uint8_t> directoryEntry(const Member& member) {
    const auto length = static_cast<unsigned>(member.name.size());
    return ZipRecord()
        .u32({0x02014B50})
        .u16({kVersion, kVersion, kUtf8, kStored, 0, kDate})
        .u32({member.checksum, kIsIn64, kIsIn64})
        .u16({length, 28, 0, 0, 0})
        .u32({0, kIsIn64})
        .text(member.name)
        .u16({kZip64, 24})
        .u64({member.size, member.size, member.offset})
        .bytes;
}

/// @param start, end of the central directory, in bytes of the file
std::vector<std::uint8_t> endRecords(std::uint64_t members, std::uint64_t start, std::uint64_t end) {
    const auto few = static_cast<unsigned>(members);
    return ZipRecord()
        .u32({0x06064B50})
        .u64({44})
        .u16({kVersion, kVersion})
        .u32({0, 0})
        .u64({members, members, end - start, start})
        .u32({0x07064B50, 0})
        .u64({end})
        .u32({1})
        .u32({0x06054B50})
        .u16({0, 0, few, few})
        .u32({kIsIn64, kIsIn64})
        .u16({0})
        .bytes;
}

class NpzSink final : public HitSink {
public:
    NpzSink(const std::string& path, std::span<const HitColumn> columns) : file_(path) {
        for (const HitColumn& column : columns) {
            HitColumn shape = column;
            shape.values.clear();
            columns_.push_back(std::move(shape));
            spools_.push_back(std::make_unique<SpoolFile>(path));
        }
    }

    void add(std::span<const HitColumn> columns, std::uint64_t) override {
        for (std::size_t c = 0; c < columns.size(); ++c) spools_[c]->append(columns[c].values);
    }

    void finish() override {
        std::vector<Member> members;
        for (std::size_t c = 0; c < columns_.size(); ++c) members.push_back(writeMember(c));
        const std::uint64_t start = written_;
        for (const Member& member : members) append(directoryEntry(member));
        append(endRecords(members.size(), start, written_));
        file_.commit();
    }

private:
    Member writeMember(std::size_t c) {
        const HitColumn& column = columns_[c];
        const SpoolFile& spool = *spools_[c];
        const std::string count = std::to_string(spool.size() / column.rowBytes());
        const std::string shape =
            column.components > 1 ? "(" + count + ", " + std::to_string(column.components) + ")" : "(" + count + ",)";
        const std::string header = npyHeader(npyDescr(column), shape);
        const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(header.data()), static_cast<uInt>(header.size()));
        const Member member{
            headerName(column) + ".npy",
            static_cast<std::uint32_t>(crc32_combine(sum, spool.checksum(), static_cast<z_off_t>(spool.size()))),
            header.size() + spool.size(), written_};
        append(localHeader(member));
        append({header.begin(), header.end()});
        spool.copyTo(file_);
        written_ += spool.size();
        return member;
    }

    void append(const std::vector<std::uint8_t>& bytes) {
        file_.append(bytes);
        written_ += bytes.size();
    }

    OutputFile file_;
    std::vector<HitColumn> columns_;
    std::vector<std::unique_ptr<SpoolFile>> spools_;
    std::uint64_t written_ = 0;
};

} // namespace

std::unique_ptr<HitSink> npzSink(const std::string& path, std::span<const HitColumn> columns) {
    return std::make_unique<NpzSink>(path, columns);
}

} // namespace pointrt
