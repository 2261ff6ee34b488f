// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/input/mesh/vtp_data.h"

#include <algorithm>
#include <cstring>
#include <lz4.h>
#include <vector>
#include <zlib.h>

#include "preprocess/ingest/text.h"
#include "preprocess/ingest/unpack_limit.h"

namespace pointrt {
namespace {

int sixBits(char letter) {
    if (letter >= 'A' && letter <= 'Z') return letter - 'A';
    if (letter >= 'a' && letter <= 'z') return letter - 'a' + 26;
    if (letter >= '0' && letter <= '9') return letter - '0' + 52;
    return letter == '+' ? 62 : letter == '/' ? 63 : -1;
}

/// Takes bytes from an array as it is stored. Base64 is decoded four letters at a time, since a length and the data
/// after it may be encoded separately, with padding in between.
class StoredBytes {
public:
    StoredBytes(const InputFile& input, std::string_view stored, bool base64)
        : input_(input), stored_(stored), base64_(base64) {}

    std::string take(std::uint64_t size) {
        if (size > stored_.size() + decoded_.size()) refuseShort();
        if (!base64_) {
            const std::string bytes(stored_.substr(0, size));
            if (bytes.size() < size) refuseShort();
            stored_.remove_prefix(size);
            return bytes;
        }
        while (decoded_.size() < size) decodeFour();
        const std::string bytes = decoded_.substr(0, size);
        decoded_.erase(0, size);
        return bytes;
    }

private:
    [[noreturn]] void refuseShort() const { refuse(input_, "truncated: an array ends before its last value"); }

    void decodeFour() {
        std::uint32_t bits = 0;
        int letters = 0, padding = 0;
        while (letters < 4) {
            if (stored_.empty()) refuseShort();
            const char letter = stored_.front();
            stored_.remove_prefix(1);
            if (isSpace(letter)) continue;
            const int six = letter == '=' ? 0 : sixBits(letter);
            if (six < 0) refuse(input_, "an array has letters that are not base64");
            bits = bits << 6 | static_cast<std::uint32_t>(six);
            padding += letter == '=';
            ++letters;
        }
        for (int i = 0; i < 3 - padding; ++i) decoded_ += static_cast<char>(bits >> (16 - 8 * i) & 255);
    }

    const InputFile& input_;
    std::string_view stored_;
    bool base64_;
    std::string decoded_; ///< decoded, but not taken yet
};

std::uint64_t takeLength(StoredBytes& bytes, bool is_long) {
    const std::string taken = bytes.take(is_long ? 8 : 4);
    std::uint64_t length = 0;
    std::memcpy(&length, taken.data(), taken.size());
    return length;
}

bool unpackBlock(const std::string& compressor, std::string_view packed, char* into, std::uint64_t size) {
    if (compressor == "vtkLZ4DataCompressor")
        return size < (std::uint64_t{1} << 31) && packed.size() < (std::uint64_t{1} << 31) &&
               LZ4_decompress_safe(packed.data(), into, static_cast<int>(packed.size()), static_cast<int>(size)) ==
                   static_cast<int>(size);
    uLongf done = size;
    return uncompress(reinterpret_cast<Bytef*>(into), &done, reinterpret_cast<const Bytef*>(packed.data()),
                      packed.size()) == Z_OK &&
           done == size;
}

/// The number of blocks, the size of all blocks but the last, the size of the last one or 0, and the packed size of
/// each.
std::string unpackBlocks(const InputFile& input, const VtpEncoding& encoding, StoredBytes& bytes, std::uint64_t size) {
    const std::uint64_t blocks = takeLength(bytes, encoding.long_lengths),
                        block_size = takeLength(bytes, encoding.long_lengths),
                        last_size = takeLength(bytes, encoding.long_lengths);
    if (blocks > input.bytes.size()) refuse(input, fmt::format("an array promises {} blocks", blocks));
    std::vector<std::uint64_t> packed_sizes(blocks);
    for (std::uint64_t& each : packed_sizes) each = takeLength(bytes, encoding.long_lengths);
    std::string unpacked(size, '\0');
    std::uint64_t done = 0;
    for (std::uint64_t i = 0; i < blocks; ++i) {
        const std::uint64_t its = i + 1 == blocks && last_size > 0 ? last_size : block_size;
        if (its > size - done ||
            !unpackBlock(encoding.compressor, bytes.take(packed_sizes[i]), unpacked.data() + done, its))
            refuse(input, "the compressed data of an array is invalid");
        done += its;
    }
    if (done < size) refuse(input, "truncated: an array ends before its last value");
    return unpacked;
}

} // namespace

std::string decodeVtpData(const InputFile& input, const VtpEncoding& encoding, std::string_view stored, bool base64,
                          std::uint64_t size) {
    const bool unpacks =
        encoding.compressor == "vtkZLibDataCompressor" || encoding.compressor == "vtkLZ4DataCompressor";
    if (!encoding.compressor.empty() && !unpacks)
        refuse(input, fmt::format("is compressed with {}; save it with zlib or without compression",
                                  inQuotes(encoding.compressor)));
    if (size > mostUnpacked(input.bytes.size())) refuse(input, fmt::format("an array promises {} bytes", size));
    StoredBytes bytes(input, stored, base64);
    if (unpacks) return unpackBlocks(input, encoding, bytes, size);
    const std::uint64_t length = takeLength(bytes, encoding.long_lengths);
    if (length < size) refuse(input, fmt::format("an array has {} bytes, but needs {}", length, size));
    return bytes.take(size);
}

} // namespace pointrt
