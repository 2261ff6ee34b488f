// SPDX-License-Identifier: Apache-2.0
#include "format/base/report_file.h"

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "format/base/error.h"
#include "format/os/atomic_file.h"
#include "format/os/descriptor.h"

namespace pointrt {

namespace {

[[noreturn]] void fail(const std::string& name, const std::string& reason) {
    throw Error(ExitCode::kCannotWrite, name + ": " + reason);
}

void writeStream(std::FILE* stream, const std::string& name, const std::string& text) {
    errno = 0;
    const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
    const bool flushed = std::fflush(stream) == 0;
    if (!written || !flushed) fail(name, std::generic_category().message(errno));
}

bool isStream(const std::string& path) {
    const auto status = statusOf(path);
    return status && (status->kind == FileKind::kPipe || status->kind == FileKind::kCharacters);
}

} // namespace

void writeReport(const std::string& path, const std::string& text) {
    if (path == "-") return writeStream(stdout, "standard output", text);
    if (isStream(path)) {
        std::FILE* const stream = std::fopen(path.c_str(), "we");
        if (!stream) fail(path, std::generic_category().message(errno));
        try {
            writeStream(stream, path, text);
        } catch (...) {
            std::fclose(stream);
            throw;
        }
        std::fclose(stream);
        return;
    }
    format::AtomicFile file;
    if (!file.open(path) || !file.write(text.data(), text.size()) || !file.commit()) fail(path, file.error());
}

void requireReportWritable(const std::string& path) {
    format::AtomicFile file;
    if (path != "-" && !isStream(path) && !file.open(path)) fail(path, file.error());
}

} // namespace pointrt
