// SPDX-License-Identifier: Apache-2.0
// Small files for the readers, written by the tests.
#pragma once

#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <zlib.h>

#include "format/base/error.h"
#include "preprocess/ingest/scalar.h"
#include "preprocess/input/detect.h"
#include "preprocess/input/read.h"
#include "tests/support/find_attribute.h"
#include "tests/support/says.h"
#include "tests/support/temporary_folder.h"

namespace pointrt {

/// A temporary folder for each test.
class InputTest : public testing::Test {
protected:
    std::string write(const std::string& name, const std::string& bytes) const { return temporary.write(name, bytes); }

    static Cloud read(const std::string& path, const ReadOptions& options = {}) { return readInputs({path}, options); }
    Cloud readText(const std::string& name, const std::string& bytes) const { return read(write(name, bytes)); }

    /// The error message of reading; a test failure and "" if it succeeds.
    static std::string reasonOf(const std::string& path, const ReadOptions& options = {}) {
        try {
            readInputs({path}, options);
        } catch (const Error& error) {
            last_code = error.code;
            const std::string reason = error.what();
            EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
            return reason;
        }
        ADD_FAILURE() << path << " was read";
        return "";
    }
    std::string reasonOfText(const std::string& name, const std::string& bytes) const {
        return reasonOf(write(name, bytes));
    }

    /// Reads every prefix of a file: each must be read or refused.
    void readPrefixes(const std::string& name, const std::string& bytes) const {
        for (std::size_t size = 0; size <= bytes.size(); ++size) {
            const std::string path = write(name, bytes.substr(0, size));
            try {
                readInputs({path}, {});
            } catch (const Error& error) {
                ASSERT_NE(size, bytes.size()) << error.what();
                ASSERT_EQ(error.code, ExitCode::kBadInput) << error.what();
            }
        }
    }

    /// Changes one byte at a time to critical values: each file, in memory, must be read, or refused with a one-line
    /// message.
    void readChangedBytes(const std::string& name, const std::string& bytes) const {
        for (std::size_t i = 0; i < bytes.size(); ++i)
            for (const char byte : {'\0', '\xff', '\x7f', '\x80', '9'}) {
                std::string changed = bytes;
                changed[i] = byte;
                const InputFile file{(folder / name).string(), changed, nullptr, false};
                Cloud cloud;
                Sink sink(cloud);
                try {
                    readInput(formatOf(file, ""), file, sink);
                } catch (const Error& error) {
                    ASSERT_EQ(error.code, ExitCode::kBadInput) << error.what();
                    ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
                }
            }
    }

    test::TemporaryFolder temporary;
    const std::filesystem::path& folder = temporary.path;
    static inline ExitCode last_code = ExitCode::kDone;
};

/// The attribute of this name; a test failure and an empty one if there is none.
inline Attribute attributeOf(const Cloud& cloud, const std::string& name) {
    if (const Attribute* const attribute = test::findAttribute(cloud, name)) return *attribute;
    ADD_FAILURE() << "no attribute " << name;
    return {};
}

/// All of its numbers, component by component.
inline std::vector<double> numbersOf(const Cloud& cloud, const std::string& name) {
    const Attribute attribute = attributeOf(cloud, name);
    std::vector<double> numbers;
    for (std::size_t at = 0; at < attribute.values.size(); at += scalarSize(attribute.type))
        numbers.push_back(loadScalar(attribute.values.data() + at, attribute.type, false));
    return numbers;
}

inline std::vector<std::string> attributeNames(const Cloud& cloud) {
    std::vector<std::string> names;
    for (const Attribute& attribute : cloud.attributes) names.push_back(attribute.name);
    return names;
}

inline std::string notesOf(const Cloud& cloud) {
    std::string all;
    for (const Note& note : cloud.notes) all += note.file + ": " + note.text + "\n";
    return all;
}

using Numbers = std::vector<double>;
using Names = std::vector<std::string>;

inline Vec3d world(const Cloud& cloud, std::size_t i) { return cloud.origin + cloud.positions[i].cast<double>(); }

inline std::string gzipped(const std::string& bytes) {
    z_stream stream{};
    deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

/// Bytes of a value, reversed for big-endian files.
template <typename Value>
std::string bytesOf(Value value, bool reversed = false) {
    std::string bytes(sizeof(Value), '\0');
    std::memcpy(bytes.data(), &value, sizeof(Value));
    return reversed ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

} // namespace pointrt
