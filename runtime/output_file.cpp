// SPDX-License-Identifier: Apache-2.0
#include "runtime/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "format/src/atomic_file.h"
#include "pointrt/tool.hpp"

namespace pointrt {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw Error{ExitCode::kCannotWrite, path + ": " + reason};
}

std::string folderOf(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    if (slash == std::string::npos) return ".";
    return slash == 0 ? "/" : path.substr(0, slash);
}

} // namespace

void writeFile(const std::string& path, std::span<const std::uint8_t> bytes) {
    format::AtomicFile file;
    if (!file.open(path) || !file.write(bytes.data(), bytes.size()) || !file.commit()) fail(path, file.error());
}

void requireWritable(const std::string& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) fail(path, std::strerror(EISDIR));
    if (access(folderOf(path).c_str(), W_OK | X_OK) != 0) fail(path, std::strerror(errno));
}

} // namespace pointrt
