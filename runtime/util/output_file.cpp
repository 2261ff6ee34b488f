// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/output_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "format/base/error.h"

namespace pointrt {

OutputFile::OutputFile(std::string path) : path_(std::move(path)) { require(!isFile() || file_.open(path_)); }

void OutputFile::append(std::span<const std::uint8_t> bytes) {
    errno = 0;
    require(isFile() ? file_.write(bytes.data(), bytes.size())
                     : std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size());
}

void OutputFile::overwrite(std::uint64_t offset, std::span<const std::uint8_t> bytes) {
    require(file_.overwrite(offset, bytes.data(), bytes.size()));
}

void OutputFile::commit() {
    errno = 0;
    require(isFile() ? file_.commit() : std::fflush(stdout) == 0);
}

void OutputFile::require(bool done) const {
    if (done) return;
    throw Error{ExitCode::kCannotWrite,
                isFile() ? path_ + ": " + file_.error() : std::string("standard output: ") + std::strerror(errno)};
}

void writeFile(const std::string& path, std::span<const std::uint8_t> bytes) {
    OutputFile file(path);
    file.append(bytes);
    file.commit();
}

void requireWritable(const std::string& path) { OutputFile file(path); }

} // namespace pointrt
