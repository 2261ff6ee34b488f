// SPDX-License-Identifier: Apache-2.0
// NumPy files for tests, implemented independently from NEP 1 and PKWARE's APPNOTE.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace pointrt::test {

/// The bytes of an .npy file with this header text.
inline std::string arrayBytes(const std::string& dict, const void* numbers, std::size_t bytes) {
    const std::string text = dict + "   \n";
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(text.size() & 0xFF) +
           static_cast<char>(text.size() >> 8) + text + std::string(static_cast<const char*>(numbers), bytes);
}

template <typename Number>
std::string rayArray(const std::vector<Number>& numbers) {
    return arrayBytes("{'descr': '<f" + std::to_string(sizeof(Number)) + "', 'fortran_order': False, 'shape': (" +
                          std::to_string(numbers.size() / 6) + ", 6), }",
                      numbers.data(), numbers.size() * sizeof(Number));
}

/// A parsed array: the header text without trailing spaces, and the numbers.
struct ReadArray {
    std::string header, data;

    template <typename Number>
    std::vector<Number> as() const {
        std::vector<Number> numbers(data.size() / sizeof(Number));
        std::memcpy(numbers.data(), data.data(), numbers.size() * sizeof(Number));
        return numbers;
    }
};

template <typename Word>
Word wordAt(const std::string& bytes, std::size_t at) {
    Word word;
    if (at + sizeof word > bytes.size()) throw std::runtime_error("cut short");
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

inline ReadArray readArray(const std::string& bytes) {
    if (bytes.substr(0, 8) != std::string("\x93NUMPY\x01\x00", 8)) throw std::runtime_error("no array of version 1.0");
    const std::size_t size = wordAt<std::uint16_t>(bytes, 8);
    if ((10 + size) % 64 != 0) throw std::runtime_error("the numbers are not aligned");
    std::string header = bytes.substr(10, size);
    header.erase(header.find_last_not_of(" \n") + 1);
    return {header, bytes.substr(10 + size)};
}

/// CRC-32 as in ISO 3309, bit by bit.
inline std::uint32_t checksumOf(const std::string& bytes) {
    std::uint32_t sum = ~0u;
    for (const char c : bytes) {
        sum ^= static_cast<std::uint8_t>(c);
        for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xEDB88320u : 0);
    }
    return ~sum;
}

/// The members of a zip file by its central directory, stored with Zip64 sizes; throws on inconsistencies.
inline std::map<std::string, std::string> zipMembers(const std::string& zip) {
    const auto require = [](bool holds, const char* what) {
        if (!holds) throw std::runtime_error(what);
    };
    require(zip.size() >= 98, "too short");
    const std::size_t end = zip.size() - 22, locator = end - 20;
    require(wordAt<std::uint32_t>(zip, end) == 0x06054B50 && wordAt<std::uint32_t>(zip, locator) == 0x07064B50, "end");
    const auto end64 = wordAt<std::uint64_t>(zip, locator + 8);
    require(wordAt<std::uint32_t>(zip, end64) == 0x06064B50, "64 bit end");
    const auto count = wordAt<std::uint64_t>(zip, end64 + 32);
    require(wordAt<std::uint16_t>(zip, end + 10) == count, "counts");
    std::size_t at = wordAt<std::uint64_t>(zip, end64 + 48);
    require(at + wordAt<std::uint64_t>(zip, end64 + 40) == end64, "size of the list");
    std::map<std::string, std::string> members;
    for (std::uint64_t i = 0; i < count; ++i) {
        require(wordAt<std::uint32_t>(zip, at) == 0x02014B50 && wordAt<std::uint16_t>(zip, at + 10) == 0, "entry");
        const std::size_t name = wordAt<std::uint16_t>(zip, at + 28), extra = at + 46 + name;
        require(wordAt<std::uint16_t>(zip, extra) == 1 && wordAt<std::uint16_t>(zip, extra + 2) == 24, "extra");
        const auto size = wordAt<std::uint64_t>(zip, extra + 4), offset = wordAt<std::uint64_t>(zip, extra + 20);
        require(wordAt<std::uint32_t>(zip, offset) == 0x04034B50, "header");
        require(zip.substr(offset + 30, name) == zip.substr(at + 46, name), "names");
        require(wordAt<std::uint64_t>(zip, offset + 30 + name + 4) == size, "sizes");
        const std::string content = zip.substr(offset + 30 + name + 20, size);
        require(checksumOf(content) == wordAt<std::uint32_t>(zip, at + 16) &&
                    checksumOf(content) == wordAt<std::uint32_t>(zip, offset + 14),
                "checksum");
        members[zip.substr(at + 46, name)] = content;
        at += 46 + name + wordAt<std::uint16_t>(zip, at + 30);
    }
    return members;
}

} // namespace pointrt::test
