// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/output_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "format/base/error.h"

namespace pointrt {

void OutputFile::Close::operator()(std::FILE* stream) const {
    if (stream != stdout) std::fclose(stream);
}

OutputFile::OutputFile(std::string path, Writing writing) : path_(std::move(path)) {
    const bool is_stream = path_ == "-" || writing == Writing::kInPlace;
    if (is_stream) stream_.reset(path_ == "-" ? stdout : std::fopen(path_.c_str(), "wb"));
    if (is_stream && !stream_) throw Error{ExitCode::kCannotWrite, path_ + ": " + std::strerror(errno)};
    require(stream_ || file_.open(path_));
}

void OutputFile::append(std::span<const std::uint8_t> bytes) {
    errno = 0;
    require(stream_ ? std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) == bytes.size()
                    : file_.write(bytes.data(), bytes.size()));
}

void OutputFile::overwrite(std::uint64_t offset, std::span<const std::uint8_t> bytes) {
    require(file_.overwrite(offset, bytes.data(), bytes.size()));
}

void OutputFile::commit() {
    errno = 0;
    require(stream_ ? std::fflush(stream_.get()) == 0 : file_.commit());
}

void OutputFile::require(bool done) const {
    if (done) return;
    throw Error{ExitCode::kCannotWrite,
                (path_ == "-" ? "standard output" : path_) + ": " + (stream_ ? std::strerror(errno) : file_.error())};
}

void writeFile(const std::string& path, std::span<const std::uint8_t> bytes) {
    OutputFile file(path);
    file.append(bytes);
    file.commit();
}

void requireWritable(const std::string& path) { OutputFile file(path); }

} // namespace pointrt
