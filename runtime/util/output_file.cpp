// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/output_file.h"

#include <utility>

#include "format/base/error.h"

namespace pointrt {

OutputFile::OutputFile(std::string path) : path_(std::move(path)) { require(file_.open(path_)); }

void OutputFile::append(std::span<const std::uint8_t> bytes) { require(file_.write(bytes.data(), bytes.size())); }

void OutputFile::overwrite(std::uint64_t offset, std::span<const std::uint8_t> bytes) {
    require(file_.overwrite(offset, bytes.data(), bytes.size()));
}

void OutputFile::commit() { require(file_.commit()); }

void OutputFile::require(bool done) const {
    if (!done) throw Error{ExitCode::kCannotWrite, path_ + ": " + file_.error()};
}

void writeFile(const std::string& path, std::span<const std::uint8_t> bytes) {
    OutputFile file(path);
    file.append(bytes);
    file.commit();
}

void requireWritable(const std::string& path) { OutputFile file(path); }

} // namespace pointrt
