// SPDX-License-Identifier: Apache-2.0
#include "runtime/util/output_file.h"

#include "format/base/atomic_file.h"
#include "format/base/error.h"

namespace pointrt {
namespace {

[[noreturn]] void fail(const std::string& path, const format::AtomicFile& file) {
    throw Error{ExitCode::kCannotWrite, path + ": " + file.error()};
}

} // namespace

void writeFile(const std::string& path, std::span<const std::uint8_t> bytes) {
    format::AtomicFile file;
    if (!file.open(path) || !file.write(bytes.data(), bytes.size()) || !file.commit()) fail(path, file);
}

void requireWritable(const std::string& path) {
    format::AtomicFile file;
    if (!file.open(path)) fail(path, file);
}

} // namespace pointrt
